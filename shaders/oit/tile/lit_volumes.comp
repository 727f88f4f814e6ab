// SPDX-License-Identifier: Apache-2.0
// Bricks and boxes of one medium in light that varies along the ray (lamps, shadows), one box after
// the other in the order of the tile's list, cell by cell. Exact where classify_boxes.comp has
// found that each pixel leaves one box before it enters the next.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/density.glsl"
#include "../../common/lighting.glsl"
#include "media.glsl"
// After kColoured:
#include "../integrate/light_steps.glsl"
#include "../integrate/quadrature.glsl"

layout(binding = kBindingBoxes, scalar) readonly buffer Boxes { BoxData boxes[]; };
layout(binding = kBindingVolumes, scalar) readonly buffer Volumes { VolumeData volumes[]; };
layout(binding = kBindingOpaqueColor) uniform sampler2D opaqueColor;
layout(binding = kBindingTileResult, rgba32f) writeonly uniform image2D result;

RealRay ray;
vec3 rayDirection;
MediumData medium;
Path path;
uint steps = 0u;

// Of the step from `from` on, within one cell.
Nodes evaluateNodes(BoxData box, LocalRay local, float begin, float from, float distance) {
    Nodes nodes;
    nodes.share = 0.0;
    [[unroll]] for (uint k = 0u; k < kNodeCount; ++k) nodes.source[k] = frame.ambient;
    // Nodes inside: a loop around a loop is not unrolled, and arrays would leave the registers.
    for (uint i = 0u; i < frame.lightCount; ++i) {
        LightData light = lights[i];
        [[unroll]] for (uint k = 0u; k < kNodeCount; ++k) {
            vec3 travel;
            vec3 position = vec3(ray.origin) + rayDirection * (begin + from + distance * kNodes[k]);
            vec3 irradiance = lightIrradiance(light, i, position, travel);
            nodes.source[k] +=
                irradiance * phaseFunction(medium.phase, medium.g, -dot(travel, rayDirection));
        }
    }
    BoxDensity density = makeBoxDensity(box, local, from + 0.5 * distance);
    [[unroll]] for (uint k = 0u; k < kNodeCount; ++k) {
        float value = boxDensity(density, from + distance * kNodes[k]);
        nodes.extinction[k] = value * medium.extinction;
        nodes.source[k] =
            value * (medium.extinction * medium.albedo * nodes.source[k] + medium.emission);
    }
    return nodes;
}

void crossBox(BoxData box, float limit) {
    VolumeData volume = volumes[box.volume];
    Real2 ends = boxChord(ray, box, volume);
    LocalRay local = localRay(ray, box, volume, ends.x);
    float begin = float(ends.x), span = float(min(ends.y, Real(limit)) - ends.x);
    float at = 0.0, stepLimit = kNoCrossing;
    while (at < span && steps < kMostSteps) {
        steps += 1u + kNodeCount * (1u + frame.lightCount);
        float target = min(min(nextPlane(box, local, at), span), at + stepLimit);
        target = min(target, at + limitStepByLights(vec3(ray.origin), rayDirection, begin + at, true));
        float distance = target - at;
        if (distance <= 0.0) break;  // rounding: nothing is left
        float error = crossVarying(path, evaluateNodes(box, local, begin, at, distance), distance);
        steps += shadowIterations;
        shadowIterations = 0u;
        stepLimit = distance * scaleStep(error);
        at = error > 1.0 ? at : target;
    }
}

float findRest() { return largest(path.surfaces * path.decay); }

// No phase function and no lamp sends more than this along the ray, per optical depth.
vec3 findLargestSource() {
    float g = abs(medium.g);
    float phase = medium.phase == kPhaseHenyeyGreenstein ? phaseHenyeyGreenstein(1.0, g)
                                                         : phaseFunction(medium.phase, 0.0, 1.0);
    vec3 light = frame.ambient;
    for (uint i = 0u; i < frame.lightCount; ++i) {
        float radius = lights[i].radius;
        bool isFar = lights[i].type == kLightDirectional;
        light += phase * lights[i].color / (isFar ? 1.0 : max(radius * radius, 1e-12));
    }
    return medium.albedo * light + medium.emission / max(medium.extinction, vec3(1e-30));
}

void main() {
    uint tile;
    uvec2 pixel;
    if (!beginPixel(tile, pixel)) return;
    ray = makeTileRay(pixel);
    rayDirection = vec3(ray.direction);
    float limit = texelFetch(opaqueT, ivec2(pixel), 0).x;
    medium = media[volumes[boxes[0].volume].medium];
    path = beginPath();
    uint box = UintArray(push.boxOffsets).at[tile];
    uint last = UintArray(push.boxOffsets).at[tile + 1u];
    bool isAbsorbed = all(lessThanEqual(medium.emission, medium.extinction * 1e20));
    float stop = isAbsorbed ? max(push.epsilon, 1e-20) : 0.0;
    while (box < last && findRest() >= stop) {
        ++steps;
        crossBox(boxes[UintArray(push.boxPairs).at[box]], limit);
        ++box;
    }
    vec3 behind = texelFetch(opaqueColor, ivec2(pixel), 0).rgb;
    vec3 rest = path.surfaces * path.decay;
    imageStore(result, ivec2(pixel), vec4(path.radiance + rest * behind, 1.0));
    if (steps >= kMostSteps)
        countExhausted();
    else if (box < last && push.epsilon > 0.0)
        countStop(boundError(rest, findLargestSource(), behind));
}
