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
#include "../integrate/light_nodes.glsl"
#include "../integrate/light_steps.glsl"
#include "../integrate/linear_light.glsl"

layout(constant_id = 6) const bool kLamps = true;  // some light is a point or spot light

layout(binding = kBindingBoxes, scalar) readonly buffer Boxes { BoxData boxes[]; };
layout(binding = kBindingVolumes, scalar) readonly buffer Volumes { VolumeData volumes[]; };
layout(binding = kBindingOpaqueColor) uniform sampler2D opaqueColor;
layout(binding = kBindingTileResult, rgba32f) writeonly uniform image2D result;

RealRay ray;
vec3 rayDirection;
MediumData medium;
Path path;
uint steps = 0u;
float evenStep = kNoCrossing;  // longest in which directional lights are smooth

float findRest() { return largest(path.surfaces * path.decay); }

void findEvenStep() {
    for (uint i = 0u; i < frame.lightCount; ++i)
        if (kShadowStores != 0u && lights[i].shadow != 0ul)
            evenStep = min(evenStep, ShadowMapRef(lights[i].shadow).map.stepLength);
}

// Where no lamp is near, light changes along a ray by shadows only. Their stores are not right to more
// than 1e-3: it is asked for at the ends of stretches within which they count as smooth, and linear
// between.
struct Stretch {
    float longest;     // m
    float begin, end;  // m behind the box's begin
    vec3 early, late;  // radiance scattered at both
};

vec3 evenLight(float place) {
    return scatteredRadiance(medium, kNoShares, vec3(ray.origin) + rayDirection * place,
                             rayDirection);
}

// Light has passed other cells on its way and changes less from cell to cell than density does; chosen
// by us: from two cells on the error beside that of the stores begins to show.
const float kCellsPerStretch = 1.5;

Stretch beginStretch(LocalRay local, float place) {
    float longest = max(evenStep, kCellsPerStretch / length(local.direction));
    return Stretch(longest, 0.0, 0.0, vec3(0), evenLight(place));
}

void advance(inout Stretch stretch, float place, float span) {
    stretch.begin = stretch.end;
    stretch.end = min(stretch.begin + stretch.longest, span);
    stretch.early = stretch.late;
    stretch.late = evenLight(place + stretch.end);
    steps += frame.lightCount;
}

vec3 lightAt(Stretch stretch, float at) {
    float share = (at - stretch.begin) / max(stretch.end - stretch.begin, 1e-30);
    return mix(stretch.early, stretch.late, clamp(share, 0.0, 1.0));
}

// Of all lights, at the nodes of a step.
void findLight(float place, float distance, out vec3 light[kNodeCount]) {
    [[unroll]] for (uint k = 0u; k < kNodeCount; ++k) light[k] = frame.ambient;
    LitStep lit =
        LitStep(vec3(ray.origin) + rayDirection * place, rayDirection, distance, true);
    // Nodes inside: a loop around a loop is not unrolled, and arrays would leave the registers.
    for (uint i = 0u; i < frame.lightCount; ++i) {
        LightNodes nodes = makeLightNodes(lights[i], i, lit, true);
        [[unroll]] for (uint k = 0u; k < kNodeCount; ++k)
            light[k] += nodes.irradiance[k] * nodes.share[k] *
                        phaseFunction(medium.phase, medium.g, nodes.cosTheta[k]);
    }
}

// Of the step from `from` on, within one cell.
Nodes evaluateNodes(BoxData box, LocalRay local, float from, float distance,
                    vec3 light[kNodeCount]) {
    Nodes nodes;
    nodes.share = 0.0;
    BoxDensity density = makeBoxDensity(box, local, from + 0.5 * distance);
    [[unroll]] for (uint k = 0u; k < kNodeCount; ++k) {
        float value = boxDensity(density, from + distance * kNodes[k]);
        nodes.extinction[k] = value * perChannel(medium.extinction);
        nodes.source[k] =
            value * (medium.extinction * medium.albedo * light[k] + medium.emission);
    }
    return nodes;
}

// Both return the error of the step from `at` on, which is taken if that is allowed.
float crossInLamps(BoxData box, LocalRay local, float begin, float at, float distance) {
    vec3 light[kNodeCount];
    findLight(begin + at, distance, light);
    steps += 1u + kShadowLookups * frame.lightCount + shadowIterations;
    shadowIterations = 0u;
    return crossVarying(path, evaluateNodes(box, local, at, distance, light), distance);
}

float crossInStretch(BoxData box, LocalRay local, Stretch stretch, float at, float distance) {
    ++steps;
    BoxDensity density = makeBoxDensity(box, local, at + 0.5 * distance);
    vec3 values;
    [[unroll]] for (int k = 0; k < 3; ++k)
        values[k] = boxDensity(density, at + distance * kLinearNodes[k]);
    return crossLinear(path, medium, values, lightAt(stretch, at), lightAt(stretch, at + distance),
                       distance);
}

// A box, its part of the ray, and how far the ray has come in it.
struct Crossing {
    LocalRay local;
    float begin, span;
    float at, stepLimit;
};

bool goesOn(Crossing crossing, float end, float stop) {
    return crossing.at < end && steps < kMostSteps && findRest() >= stop;
}

// One step, towards `end` at most. Always gets further, or shortens the next step.
void crossCell(BoxData box, float end, Stretch stretch, inout Crossing crossing) {
    float at = crossing.at;
    float target = min(min(nextPlane(box, crossing.local, at), end), at + crossing.stepLimit);
    if (kLamps)
        target = min(target, at + limitStepByLights(vec3(ray.origin), rayDirection,
                                                    crossing.begin + at, true));
    float distance = target - at;
    if (distance <= 0.0) {  // rounding: nothing is left
        crossing.at = end;
        return;
    }
    float error = kLamps ? crossInLamps(box, crossing.local, crossing.begin, at, distance)
                         : crossInStretch(box, crossing.local, stretch, at, distance);
    crossing.stepLimit = distance * scaleStep(error);
    crossing.at = error > 1.0 ? at : target;
}

void crossBox(BoxData box, float limit, float stop) {
    VolumeData volume = volumes[box.volume];
    Real2 ends = boxChord(ray, box, volume);
    Crossing crossing;
    crossing.local = localRay(ray, box, volume, ends.x);
    crossing.begin = float(ends.x);
    crossing.span = float(min(ends.y, Real(limit)) - ends.x);
    crossing.at = 0.0;
    crossing.stepLimit = kNoCrossing;
    Stretch stretch;
    if (!kLamps) stretch = beginStretch(crossing.local, crossing.begin);
    while (goesOn(crossing, crossing.span, stop)) {
        ++steps;
        if (!kLamps) advance(stretch, crossing.begin, crossing.span);
        float end = kLamps ? crossing.span : stretch.end;
        while (goesOn(crossing, end, stop)) crossCell(box, end, stretch, crossing);
    }
}

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
    if (!kLamps) findEvenStep();
    uint box = UintArray(push.boxOffsets).at[tile];
    uint last = UintArray(push.boxOffsets).at[tile + 1u];
    bool isAbsorbed = all(lessThanEqual(medium.emission, medium.extinction * 1e20));
    float stop = isAbsorbed ? max(push.epsilon, 1e-20) : 0.0;
    while (box < last && findRest() >= stop) {
        ++steps;
        crossBox(boxes[UintArray(push.boxPairs).at[box]], limit, stop);
        ++box;
    }
    vec3 behind = texelFetch(opaqueColor, ivec2(pixel), 0).rgb;
    vec3 rest = path.surfaces * path.decay;
    imageStore(result, ivec2(pixel), vec4(path.radiance + rest * behind, 1.0));
    if (steps >= kMostSteps)
        countExhausted();
    else if (findRest() < stop && push.epsilon > 0.0)
        countStop(boundError(rest, findLargestSource(), behind));
}
