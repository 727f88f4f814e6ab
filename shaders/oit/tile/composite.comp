// SPDX-License-Identifier: Apache-2.0
// Composites the spheres of a tile front to back in the order of its list. Exact where
// classify.comp has found that the intervals of each pixel lie one behind the other, or have one
// common source, so that their order does not matter.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/lighting.glsl"
#include "column.glsl"

layout(binding = kBindingOpaqueColor) uniform sampler2D opaqueColor;
layout(binding = kBindingTileResult, rgba32f) writeonly uniform image2D result;

// Radiance per metre of a medium of density 1, without shadows, and of a sphere that is shadowed as
// a whole.
vec3 sources[kRows * kTileMedia];
vec3 sphereSources[kRows];
// One common source: the sum of density times length, with what rounding has taken from it. Else
// the transmittance so far, likewise, and the radiance.
vec3 sums[kRows];
vec3 lost[kRows];
vec3 radiances[kRows];

MediumData loadMedium(uint m) { return media[kOneSource ? spheres[0].medium : m]; }

void beginRows() {
    [[unroll]] for (uint row = 0u; row < kRows; ++row) {
        sums[row] = vec3(kOneSource ? 0.0 : 1.0);
        lost[row] = radiances[row] = vec3(0);
        [[unroll]] for (uint m = 0u; m < kMediumCount; ++m) sources[row * kTileMedia + m] =
            frame.ambient;
    }
    // Rows inside: loops around loops are not unrolled, and arrays would leave the registers.
    for (uint i = 0u; i < frame.lightCount; ++i) {
        vec3 travel;
        vec3 irradiance = freeIrradiance(lights[i], vec3(0), travel);
        [[unroll]] for (uint m = 0u; m < kMediumCount; ++m) {
            MediumData medium = loadMedium(m);
            [[unroll]] for (uint row = 0u; row < kRows; ++row) sources[row * kTileMedia + m] +=
                irradiance *
                phaseFunction(medium.phase, medium.g, -dot(travel, vec3(rays[row].direction)));
        }
    }
    [[unroll]] for (uint m = 0u; m < kMediumCount; ++m) {
        MediumData medium = loadMedium(m);
        [[unroll]] for (uint row = 0u; row < kRows; ++row) sources[row * kTileMedia + m] =
            medium.extinction * medium.albedo * sources[row * kTileMedia + m] + medium.emission;
    }
}

void findSphereSources(SphereData sphere) {
    MediumData medium = media[sphere.medium];
    [[unroll]] for (uint row = 0u; row < kRows; ++row) sphereSources[row] = frame.ambient;
    for (uint i = 0u; i < frame.lightCount; ++i) {
        vec3 travel;
        vec3 irradiance = freeIrradiance(lights[i], vec3(0), travel);
        irradiance *= mediumShare(sphere.shares, i, vec3(0));
        [[unroll]] for (uint row = 0u; row < kRows; ++row) sphereSources[row] +=
            irradiance *
            phaseFunction(medium.phase, medium.g, -dot(travel, vec3(rays[row].direction)));
    }
    [[unroll]] for (uint row = 0u; row < kRows; ++row) sphereSources[row] =
        medium.extinction * medium.albedo * sphereSources[row] + medium.emission;
}

void crossSphere(uint row, SphereData sphere, vec3 extinction) {
    float length = densityLength(sphere, findChord(rays[row], limits[row], sphere));
    if (kOneSource) {
        addLength(sums[row].x, lost[row].x, length);
        return;
    }
    vec3 depth = min(extinction * length, vec3(1e30));
    vec3 before = perChannel(sums[row]);
    vec3 weight = before * (length * meanDecay(depth, expChannels(-depth)));
    vec3 source = sources[row * kTileMedia];
    [[unroll]] for (uint m = 1u; m < kMediumCount; ++m) if (sphere.medium == m) source =
        sources[row * kTileMedia + m];
    if (kWholeShadows) source = sphereSources[row];
    radiances[row] += weight * sphere.tint * source;
    precise vec3 next = -weight * extinction - perChannel(lost[row]);
    precise vec3 sum = before + next;
    lost[row] = (sum - before) - next;
    sums[row] = sum;
}

// Of the column: the shortest sum, or the largest transmittance.
float findWorst() {
    float worst = kOneSource ? 3e38 : 0.0;
    [[unroll]] for (uint row = 0u; row < kRows; ++row) {
        bool isSeen = limits[row] >= 0.0;
        vec3 sum = perChannel(sums[row]);
        worst = kOneSource ? min(worst, isSeen ? sum.x : 3e38)
                           : max(worst, isSeen ? max(sum.x, max(sum.y, sum.z)) : 0.0);
    }
    return worst;
}

// The largest radiance per optical depth of any medium; none may glow without absorbing.
vec3 findLargestSource(uint row) {
    vec3 largest = vec3(0);
    [[unroll]] for (uint m = 0u; m < kMediumCount; ++m) largest =
        max(largest, sources[row * kTileMedia + m] / max(loadMedium(m).extinction, vec3(1e-30)));
    return largest * push.largestTint;
}

bool canStop() {
    bool isAbsorbed = true;
    [[unroll]] for (uint m = 0u; m < kMediumCount; ++m) {
        MediumData medium = loadMedium(m);
        isAbsorbed = isAbsorbed && all(lessThanEqual(medium.emission, medium.extinction * 1e20));
    }
    return isAbsorbed;
}

// Returns what the pixel may be off if the column has stopped early.
float finishRow(uint row, vec3 extinction) {
    ivec2 pixel = ivec2(corner + uvec2(0u, row));
    vec3 rest = max(perChannel(sums[row]), 0.0);
    if (kOneSource) {
        float length = sums[row].x;
        vec3 depth = min(extinction * length, vec3(1e30));
        rest = expChannels(-depth);
        radiances[row] =
            spheres[0].tint * sources[row * kTileMedia] * (length * meanDecay(depth, rest));
    }
    if (!all(lessThan(pixel, ivec2(frame.size)))) return 0.0;
    vec3 behind = texelFetch(opaqueColor, pixel, 0).rgb;
    imageStore(result, pixel, vec4(radiances[row] + rest * behind, 1.0));
    return boundError(rest, findLargestSource(row), behind);
}

void main() {
    uint tile;
    if (!beginColumn(tile)) return;
    beginRows();
    vec3 first = perChannel(loadMedium(0u).extinction);
    float enough = findEnough(first);
    float worst = kOneSource ? 0.0 : 1.0;
    uint k = UintArray(push.sphereOffsets).at[tile];
    uint last = UintArray(push.sphereOffsets).at[tile + 1u];
    float epsilon = kOneSource || canStop() ? push.epsilon : 0.0;
    while (k < last) {
        SphereData sphere = spheres[UintArray(push.spherePairs).at[k]];
        ++k;
        vec3 extinction = kOneSource ? first : perChannel(media[sphere.medium].extinction);
        if (kWholeShadows) findSphereSources(sphere);
        [[unroll]] for (uint row = 0u; row < kRows; ++row) crossSphere(row, sphere, extinction);
        worst = findWorst();
        if (kOneSource ? worst > enough : worst < epsilon) break;
    }
    float bound = 0.0;
    [[unroll]] for (uint row = 0u; row < kRows; ++row) bound = max(bound, finishRow(row, first));
    if (k < last) countStop(bound);
}
