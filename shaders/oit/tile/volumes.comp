// SPDX-License-Identifier: Apache-2.0
// Bricks, boxes and spheres of one common source: what a pixel sees depends on nothing but their
// summed optical depth, so that they may overlap in any order. Inside a cell the density is a cubic
// along the ray, which Gauss's rule integrates exactly.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/density.glsl"
#include "../../common/lighting.glsl"
#include "media.glsl"

layout(binding = kBindingBoxes, scalar) readonly buffer Boxes { BoxData boxes[]; };
layout(binding = kBindingVolumes, scalar) readonly buffer Volumes { VolumeData volumes[]; };
layout(binding = kBindingOpaqueColor) uniform sampler2D opaqueColor;
layout(binding = kBindingTileResult, rgba32f) writeonly uniform image2D result;

// Of Gauss's rule with two points, exact for cubics.
const vec2 kNodes = vec2(0.2113248654051871, 0.7886751345948129);

uint steps = 0u;

float integrateBox(RealRay ray, float limit, BoxData box) {
    VolumeData volume = volumes[box.volume];
    Real2 ends = boxChord(ray, box, volume);
    float span = float(min(ends.y, Real(limit)) - ends.x);
    LocalRay local = localRay(ray, box, volume, ends.x);
    float sum = 0.0, at = 0.0;
    while (at < span && steps < kMostSteps) {
        ++steps;
        float next = max(min(nextPlane(box, local, at), span), at);
        float step = next - at;
        BoxDensity density = makeBoxDensity(box, local, at + 0.5 * step);
        sum +=
            0.5 * step *
            (boxDensity(density, at + step * kNodes.x) + boxDensity(density, at + step * kNodes.y));
        at = next > at ? next : span;
    }
    return sum;
}

void main() {
    uint tile;
    uvec2 pixel;
    if (!beginPixel(tile, pixel)) return;
    RealRay ray = makeTileRay(pixel);
    float limit = texelFetch(opaqueT, ivec2(pixel), 0).x;
    uint box = UintArray(push.boxOffsets).at[tile];
    uint lastBox = UintArray(push.boxOffsets).at[tile + 1u];
    uint sphere = UintArray(push.sphereOffsets).at[tile];
    uint lastSphere = UintArray(push.sphereOffsets).at[tile + 1u];
    MediumData medium = media[volumes[boxes[0].volume].medium];
    vec3 extinction = perChannel(medium.extinction);
    float enough = findEnough(extinction);

    float sum = 0.0, lost = 0.0;
    while (box < lastBox && sum <= enough) {
        ++steps;
        addLength(sum, lost, integrateBox(ray, limit, boxes[UintArray(push.boxPairs).at[box]]));
        ++box;
    }
    while (sphere < lastSphere && sum <= enough) {
        ++steps;
        SphereData data = spheres[UintArray(push.spherePairs).at[sphere]];
        addLength(sum, lost, densityLength(data, findChord(ray, limit, data)));
        ++sphere;
    }
    vec3 light = scatteredRadiance(medium, kNoShares, vec3(0), vec3(ray.direction));
    vec3 source = medium.extinction * medium.albedo * light + medium.emission;
    vec3 depth = min(extinction * sum, vec3(1e30));
    vec3 rest = expChannels(-depth);
    vec3 radiance = source * (sum * meanDecay(depth, rest));
    vec3 behind = texelFetch(opaqueColor, ivec2(pixel), 0).rgb;
    imageStore(result, ivec2(pixel), vec4(radiance + rest * behind, 1.0));
    vec3 most = push.largestTint * source / max(extinction, vec3(1e-30));
    if (steps >= kMostSteps)
        countExhausted();
    else if (box < lastBox || sphere < lastSphere)
        countStop(boundError(rest, most, behind));
}
