// SPDX-License-Identifier: Apache-2.0
// One pixel per invocation, one tile per workgroup: the tile's media are crossed one after the
// other, in the order in which this pixel's ray enters the next box and the next sphere of the lists.
// Density and light are asked for in the middle of each step and taken as constant along it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/density.glsl"
#include "../../common/exponential.glsl"
#include "../../common/lighting.glsl"
#include "../../gpu/address.glsl"
#include "march.h"

layout(local_size_x = kTileSize, local_size_y = kTileSize) in;
layout(constant_id = 0) const bool kColoured = true;  // extinction differs between channels
layout(constant_id = 1) const bool kBoxes = true;
layout(constant_id = 2) const bool kSpheres = true;
layout(push_constant, scalar) uniform Push { MarchPush push; };
layout(binding = kBindingSpheres, scalar) readonly buffer Spheres { SphereData spheres[]; };
layout(binding = kBindingBoxes, scalar) readonly buffer Boxes { BoxData boxes[]; };
layout(binding = kBindingVolumes, scalar) readonly buffer Volumes { VolumeData volumes[]; };
layout(binding = kBindingOpaqueT) uniform sampler2D opaqueT;
layout(binding = kBindingMarchResult, rgba32f) uniform image2D result;
layout(buffer_reference, scalar) buffer CounterBlock { MarchCounters counters; };

// Loops of the whole invocation: some devices silently end them after 65 535 iterations.
const uint kMostTurns = 60000u;

RealRay ray;
vec3 origin, direction;
float limit;  // distance of the opaque surface
vec3 radiance = vec3(0), rest = vec3(1);
uint turns = 0u, stepCount = 0u;

bool isSeen() { return max(rest.x, max(rest.y, rest.z)) >= push.epsilon && turns < kMostTurns; }

// Equal steps along a chord, none longer than `longest`.
struct Steps {
    float begin, distance;  // m, of the chord's begin and of each step
    uint count;
};

Steps makeSteps(float begin, float end, float longest) {
    float span = max(min(end, limit) - begin, 0.0);
    float count = clamp(ceil(span / longest), 0.0, float(kMostTurns));
    return Steps(begin, span / max(count, 1.0), uint(count));
}

void addStep(MediumData medium, uint shares, float density, vec3 tint, float at,
             float distance) {
    vec3 extinction = density * medium.extinction;
    if (!kColoured) extinction = extinction.xxx;
    vec3 depth = min(extinction * distance, vec3(1e30));
    vec3 decay = kColoured ? exp(-depth) : vec3(exp(-depth.x));
    vec3 light = scatteredRadiance(medium, shares, origin + direction * at, direction);
    vec3 source = density * tint * (medium.extinction * medium.albedo * light + medium.emission);
    radiance += rest * source * (distance * meanDecay(depth, decay));
    rest *= decay;
    turns += 1u + frame.lightCount + shadowIterations;
    shadowIterations = 0u;
    ++stepCount;
}

void marchBox(BoxData box, Real2 ends) {
    VolumeData volume = volumes[box.volume];
    MediumData medium = media[volume.medium];
    LocalRay local = localRay(ray, box, volume, ends.x);
    Steps steps = makeSteps(float(ends.x), float(ends.y), push.step / length(local.direction));
    for (uint i = 0u; i < steps.count && isSeen(); ++i) {
        float offset = (float(i) + 0.5) * steps.distance;
        BoxDensity density = makeBoxDensity(box, local, offset);
        addStep(medium, kNoShares, boxDensity(density, offset), vec3(1), steps.begin + offset,
                steps.distance);
    }
}

void marchSphere(SphereData sphere, Real2 ends) {
    MediumData medium = media[sphere.medium];
    SphereDensity density = makeSphereDensity(ray, sphere, ends.x);
    Steps steps = makeSteps(float(ends.x), float(ends.y), push.step * 0.125 * sphere.radius);
    for (uint i = 0u; i < steps.count && isSeen(); ++i) {
        float offset = (float(i) + 0.5) * steps.distance;
        addStep(medium, sphere.shares, sphereDensity(density, offset), sphere.tint,
                steps.begin + offset, steps.distance);
    }
}

void marchMedia(uint tile) {
    uint box = UintArray(push.boxOffsets).at[tile];
    uint lastBox = kBoxes ? UintArray(push.boxOffsets).at[tile + 1u] : box;
    uint sphere = UintArray(push.sphereOffsets).at[tile];
    uint lastSphere = kSpheres ? UintArray(push.sphereOffsets).at[tile + 1u] : sphere;
    while ((box < lastBox || sphere < lastSphere) && isSeen()) {
        ++turns;
        BoxData nextBox;
        SphereData nextSphere;
        Real2 boxEnds = Real2(3e38), sphereEnds = Real2(3e38);
        if (kBoxes && box < lastBox) {
            nextBox = boxes[UintArray(push.boxPairs).at[box]];
            boxEnds = boxChord(ray, nextBox, volumes[nextBox.volume]);
        }
        if (kSpheres && sphere < lastSphere) {
            nextSphere = spheres[UintArray(push.spherePairs).at[sphere]];
            sphereEnds = sphereChord(ray, nextSphere);
        }
        bool isBox = kBoxes && box < lastBox &&
                     (!kSpheres || sphere >= lastSphere || boxEnds.x <= sphereEnds.x);
        if (isBox) {
            marchBox(nextBox, boxEnds);
            ++box;
        } else if (kSpheres) {
            marchSphere(nextSphere, sphereEnds);
            ++sphere;
        }
    }
}

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, frame.size))) return;
    ray = makeRealRay(vec2(pixel) + 0.5);
    origin = vec3(ray.origin);
    direction = vec3(ray.direction);
    limit = texelFetch(opaqueT, ivec2(pixel), 0).x;
    marchMedia(gl_WorkGroupID.y * frame.tiles.x + gl_WorkGroupID.x);
    vec3 behind = imageLoad(result, ivec2(pixel)).rgb;
    imageStore(result, ivec2(pixel), vec4(radiance + rest * behind, 1.0));
    atomicAdd(CounterBlock(push.counters).counters.steps, stepCount);
    if (turns >= kMostTurns) atomicAdd(CounterBlock(push.counters).counters.exhausted, 1u);
}
