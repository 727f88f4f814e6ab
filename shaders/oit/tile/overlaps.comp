// SPDX-License-Identifier: Apache-2.0
// Spheres of constant density and different sources that overlap: their extinctions and sources
// add up between events, the ends of spheres. All pixels of a tile go through the events in the
// order in which the ray through its middle meets them. Each pixel puts right in a small sorted
// window where its own order is another, and finds out if the window was too small: the order is
// right if what leaves the window never goes back.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "column_light.glsl"
#include "order.glsl"

layout(constant_id = 6) const uint kWindow = 12u;  // events; the time grows with their number
layout(constant_id = 7) const uint kClassIfSmall =
    kClassLists;  // what a tile needs if it was too small
layout(constant_id = 8) const
    bool kTinted = true;  // spheres of one medium differ in what they send
layout(binding = kBindingOpaqueColor) uniform sampler2D opaqueColor;
layout(binding = kBindingTileResult, rgba32f) writeonly uniform image2D result;

const Real kNowhere = Real(1e30);  // behind all that is there, so it never leaves a window

struct Event {
    Real distance;  // < 0: none, to fill the window
    float change;   // of density, in the last two bits the medium
    vec3 source;    // change of radiance per metre, if kTinted
};

Real distances[kRows * kWindow];
float changes[kRows * kWindow];
vec3 sourceChanges[kRows * kWindow];

// Of the open spheres, with what rounding has taken.
float densities[kRows * kTileMedia];
float densitiesLo[kRows * kTileMedia];
vec3 openSources[kRows];
vec3 openSourcesLo[kRows];

// What of each medium's density and length has been seen: with its source, its radiance.
vec3 amounts[kRows * kTileMedia];
vec3 tintedRadiances[kRows];

vec3 extinctions[kTileMedia];
Real positions[kRows];
vec3 rests[kRows];  // transmittance
vec3 lost[kRows];
bool isDisordered = false;

float packChange(float density, uint medium) {
    return uintBitsToFloat((floatBitsToUint(density) & ~3u) | medium);
}

void beginRows() {
    beginSources();
    [[unroll]] for (uint i = 0u; i < kRows * kWindow; ++i) {
        distances[i] = Real(-1);
        changes[i] = 0.0;
        sourceChanges[i] = vec3(0);
    }
    [[unroll]] for (uint i = 0u; i < kRows * kTileMedia; ++i) {
        densities[i] = densitiesLo[i] = 0.0;
        amounts[i] = vec3(0);
    }
    [[unroll]] for (uint row = 0u; row < kRows; ++row) {
        positions[row] = Real(0);
        rests[row] = vec3(1);
        lost[row] = tintedRadiances[row] = openSources[row] = openSourcesLo[row] = vec3(0);
    }
    [[unroll]] for (uint m = 0u; m < kMediumCount; ++m) extinctions[m] =
        perChannel(media[m].extinction);
}

Event makeEvent(uint row, SphereData sphere, bool isEnd) {
    Real2 chord = sphereChord(rays[row], sphere);
    Real limit = Real(max(limits[row], 0.0));
    bool isMet = chord.y > chord.x && chord.x < limit;
    float density = isEnd ? -sphere.density : sphere.density;
    Event event;
    event.distance = isMet ? min(isEnd ? chord.y : chord.x, limit) : Real(-1);
    event.change = isMet ? packChange(density, sphere.medium) : 0.0;
    event.source = vec3(0);
    if (kTinted && isMet) event.source = density * sphere.tint * findSource(row, sphere.medium);
    return event;
}

// Puts the event into the row's window; returns the first one that was there.
Event exchange(uint row, Event event) {
    Event first = event;
    [[unroll]] for (uint i = 0u; i < kWindow; ++i) {
        uint slot = row * kWindow + i;
        bool isBefore = distances[slot] < event.distance;
        Event low;
        low.distance = isBefore ? distances[slot] : event.distance;
        low.change = isBefore ? changes[slot] : event.change;
        event.distance = isBefore ? event.distance : distances[slot];
        event.change = isBefore ? event.change : changes[slot];
        if (kTinted) {
            low.source = isBefore ? sourceChanges[slot] : event.source;
            event.source = isBefore ? event.source : sourceChanges[slot];
        }
        if (i == 0u) {
            first = low;
        } else {
            distances[slot - 1u] = low.distance;
            changes[slot - 1u] = low.change;
            sourceChanges[slot - 1u] = low.source;
        }
    }
    distances[row * kWindow + kWindow - 1u] = event.distance;
    changes[row * kWindow + kWindow - 1u] = event.change;
    sourceChanges[row * kWindow + kWindow - 1u] = event.source;
    return first;
}

void crossTo(uint row, Real distance) {
    float open[kTileMedia];
    vec3 extinction = vec3(0);
    [[unroll]] for (uint m = 0u; m < kMediumCount; ++m) {
        open[m] = densities[row * kTileMedia + m] + densitiesLo[row * kTileMedia + m];
        extinction += open[m] * extinctions[m];
    }
    bool isAhead = distance > positions[row];
    float length = isAhead ? float(distance - positions[row]) : 0.0;
    positions[row] = isAhead ? distance : positions[row];
    vec3 depth = min(extinction * length, vec3(1e30));
    vec3 before = perChannel(rests[row]);
    vec3 weight = before * (length * meanDecay(depth, expChannels(-depth)));
    if (kTinted)
        tintedRadiances[row] += weight * (openSources[row] + openSourcesLo[row]);
    else [[unroll]]
        for (uint m = 0u; m < kMediumCount; ++m) amounts[row * kTileMedia + m] += weight * open[m];
    precise vec3 next = -weight * extinction - perChannel(lost[row]);
    precise vec3 sum = before + next;
    lost[row] = (sum - before) - next;
    rests[row] = sum;
}

void meetEvent(uint row, Event event) {
    bool isThere = event.distance >= Real(0);
    isDisordered = isDisordered || (isThere && event.distance < positions[row]);
    crossTo(row, event.distance);
    uint medium = floatBitsToUint(event.change) & 3u;
    float change = packChange(event.change, 0u);
    [[unroll]] for (uint m = 0u; m < kMediumCount; ++m) {
        uint i = row * kTileMedia + m;
        addExactly(densities[i], densitiesLo[i], medium == m ? change : 0.0);
    }
    if (kTinted) addExactly(openSources[row], openSourcesLo[row], event.source);
}

// Of the column: the largest transmittance.
float findWorst() {
    float worst = 0.0;
    [[unroll]] for (uint row = 0u; row < kRows; ++row) {
        float rest = largest(perChannel(rests[row]));
        worst = max(worst, limits[row] >= 0.0 ? rest : 0.0);
    }
    return worst;
}

// Returns what the pixel may be off if the column has stopped early.
float finishRow(uint row) {
    ivec2 pixel = ivec2(corner + uvec2(0u, row));
    if (!all(lessThan(pixel, ivec2(frame.size)))) return 0.0;
    vec3 rest = max(perChannel(rests[row]), 0.0);
    vec3 behind = texelFetch(opaqueColor, pixel, 0).rgb;
    vec3 radiance = tintedRadiances[row];
    [[unroll]] for (uint m = 0u; m < kMediumCount; ++m) radiance +=
        perChannel(amounts[row * kTileMedia + m]) * sources[row * kTileMedia + m] * spheres[0].tint;
    imageStore(result, pixel, vec4(radiance + rest * behind, 1.0));
    return boundError(rest, findLargestSource(row), behind);
}

void main() {
    uint tile;
    if (!beginColumn(tile)) return;
    beginRows();
    RealRay middle = makeMiddleRay(tile);
    uint begin = UintArray(push.sphereOffsets).at[tile], end = begin;
    uint last = UintArray(push.sphereOffsets).at[tile + 1u];
    uint steps = min(2u * (last - begin) + kWindow, kMostSteps);
    SphereData entered = spheres[UintArray(push.spherePairs).at[begin]];
    SphereData left = spheres[UintArray(push.sphereEnds).at[end]];
    float enterKey = middleDistance(middle, entered, false);
    float leaveKey = middleDistance(middle, left, true);
    float epsilon = canStop() ? push.epsilon : 0.0;
    uint step = 0u;
    while (step < steps) {
        ++step;
        bool isEnd = end < last && (begin == last || leaveKey <= enterKey);
        bool isNone = begin == last && end == last;
        SphereData sphere = left;
        if (!isEnd) sphere = entered;
        if (kWholeShadows) findSphereSources(sphere);
        [[unroll]] for (uint row = 0u; row < kRows; ++row) {
            Event event = makeEvent(row, sphere, isEnd);
            event.distance = isNone ? kNowhere : event.distance;
            event.change = isNone ? 0.0 : event.change;
            event = exchange(row, event);
            meetEvent(row, event);
        }
        if (findWorst() < epsilon) break;
        end += isEnd ? 1u : 0u;
        begin += isEnd || isNone ? 0u : 1u;
        uint next = min(isEnd ? end : begin, last - 1u);
        uint index =
            isEnd ? UintArray(push.sphereEnds).at[next] : UintArray(push.spherePairs).at[next];
        SphereData loaded = spheres[index];
        float key = middleDistance(middle, loaded, isEnd);
        if (isEnd) {
            left = loaded;
            leaveKey = key;
        } else {
            entered = loaded;
            enterKey = key;
        }
    }
    float bound = 0.0;
    [[unroll]] for (uint row = 0u; row < kRows; ++row) bound = max(bound, finishRow(row));
    if (step < steps) countStop(bound);
    if (isDisordered) atomicMax(UintArray(push.classes).at[tile], kClassIfSmall);
    if (step == kMostSteps) countExhausted();
}
