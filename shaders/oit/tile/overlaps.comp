// SPDX-License-Identifier: Apache-2.0
// Spheres of constant density and different sources that overlap: their extinctions and sources
// add up between events. A few intervals at a time are kept in registers. What begins in front of
// the smallest possible distance of the next medium in the list is known for certain and can be
// crossed, which makes room; a tile in which there is none gets the lists of each pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/lighting.glsl"
#include "media.glsl"

layout(constant_id = 6) const uint kOpenIntervals = kManyIntervals;
layout(constant_id = 7) const uint kClassIfFull = kClassLists;  // what a tile needs then
layout(binding = kBindingOpaqueColor) uniform sampler2D opaqueColor;
layout(binding = kBindingTileResult, rgba32f) writeonly uniform image2D result;

const Real kNowhere = Real(1e30);

// The intervals that are open or may open; those that end before `position` are free.
Real begins[kOpenIntervals];
Real ends[kOpenIntervals];
vec3 extinctions[kOpenIntervals];  // 1/m
vec3 sources[kOpenIntervals];      // radiance per metre
vec3 mediumSources[kTileMedia];    // of density 1, without shadows
vec3 rayDirection;
Path path;
Real position = Real(0);
uint steps = 0u;

vec3 findMediumSource(MediumData medium, uint shares) {
    vec3 light = scatteredRadiance(medium, shares, vec3(0), rayDirection);
    return medium.extinction * medium.albedo * light + medium.emission;
}

void findMediumSources() {
    [[unroll]] for (uint m = 0u; m < kMediumCount; ++m)
        mediumSources[m] = findMediumSource(media[m], kNoShares);
}

float findRest() { return largest(path.surfaces * path.decay); }

// Crosses everything up to `goal`, event by event, unless the pixel stops before.
void advance(Real goal, float stop) {
    while (position < goal && steps < kMostSteps) {
        ++steps;
        Real next = goal;
        vec3 extinction = vec3(0), source = vec3(0);
        [[unroll]] for (uint i = 0u; i < kOpenIntervals; ++i) {
            bool isAhead = begins[i] > position;
            Real event = isAhead ? begins[i] : ends[i];
            next = event > position ? min(next, event) : next;
            bool isOpen = !isAhead && ends[i] > position;
            extinction += isOpen ? perChannel(extinctions[i]) : vec3(0);
            source += isOpen ? sources[i] : vec3(0);
        }
        crossConstant(path, extinction, source, float(next - position));
        position = next;
        if (findRest() < stop) break;
    }
}

// False if there is no room.
bool insertInterval(Real begin, Real end, SphereData sphere) {
    vec3 extinction = sphere.density * media[sphere.medium].extinction;
    vec3 source = mediumSources[0];
    [[unroll]] for (uint m = 1u; m < kMediumCount; ++m) source =
        sphere.medium == m ? mediumSources[m] : source;
    if (kWholeShadows) source = findMediumSource(media[sphere.medium], sphere.shares);
    source *= sphere.tint * sphere.density;
    bool isPlaced = false;
    [[unroll]] for (uint i = 0u; i < kOpenIntervals; ++i) {
        bool takes = !isPlaced && ends[i] <= position;
        begins[i] = takes ? begin : begins[i];
        ends[i] = takes ? end : ends[i];
        extinctions[i] = takes ? extinction : extinctions[i];
        sources[i] = takes ? source : sources[i];
        isPlaced = isPlaced || takes;
    }
    return isPlaced;
}

bool hasRoom() {
    bool room = false;
    [[unroll]] for (uint i = 0u; i < kOpenIntervals; ++i) room = room || ends[i] <= position;
    return room;
}

// No ray meets the sphere, nor any that stands behind it in the list, before this distance.
Real smallestDistance(SphereData sphere) {
    float distance = kOrthographic ? dot(sphere.center, frame.forward) : length(sphere.center);
    return Real(distance - sphere.radius - 2e-6 * (abs(distance) + sphere.radius));
}

void main() {
    uint tile;
    uvec2 pixel;
    if (!beginPixel(tile, pixel)) return;
    RealRay ray = makeTileRay(pixel);
    Real limit = min(Real(texelFetch(opaqueT, ivec2(pixel), 0).x), kNowhere);
    rayDirection = vec3(ray.direction);
    findMediumSources();
    path = beginPath();
    [[unroll]] for (uint i = 0u; i < kOpenIntervals; ++i) begins[i] = ends[i] = Real(0);

    float stop = max(push.epsilon, 1e-20);
    uint k = UintArray(push.sphereOffsets).at[tile];
    uint last = UintArray(push.sphereOffsets).at[tile + 1u];
    bool isLost = false;
    while (k < last && findRest() >= stop && !isLost) {
        ++steps;
        SphereData sphere = spheres[UintArray(push.spherePairs).at[k]];
        ++k;
        Real2 chord = sphereChord(ray, sphere);
        chord.y = min(chord.y, limit);
        bool isMet = chord.y > chord.x;
        advance(isMet && !hasRoom() ? min(smallestDistance(sphere), limit) : position, stop);
        isLost = isMet && !insertInterval(chord.x, chord.y, sphere) && findRest() >= stop;
    }
    advance(k < last || isLost ? position : limit, stop);
    if (isLost) atomicMax(UintArray(push.classes).at[tile], kClassIfFull);
    if (steps >= kMostSteps) countExhausted();

    vec3 rest = path.surfaces * path.decay;
    vec3 behind = texelFetch(opaqueColor, ivec2(pixel), 0).rgb;
    imageStore(result, ivec2(pixel), vec4(path.radiance + rest * behind, 1.0));
    if (findRest() < stop && push.epsilon > 0.0) {
        vec3 most = vec3(0);
        [[unroll]] for (uint m = 0u; m < kMediumCount; ++m) most =
            max(most, mediumSources[m] / max(media[m].extinction, vec3(1e-30)));
        countStop(boundError(rest, most * push.largestTint, behind));
    }
}
