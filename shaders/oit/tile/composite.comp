// SPDX-License-Identifier: Apache-2.0
// Composites the spheres of a tile front to back in the order of its list. Exact where
// classify.comp has found that the intervals of each pixel lie one behind the other, or have one
// common source, so that their order does not matter.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "column_light.glsl"

layout(binding = kBindingOpaqueColor) uniform sampler2D opaqueColor;
layout(binding = kBindingTileResult, rgba32f) writeonly uniform image2D result;

// One common source: the sum of density times length, with what rounding has taken from it. Else
// the transmittance so far, likewise, and the radiance.
vec3 sums[kRows];
vec3 lost[kRows];
vec3 radiances[kRows];

void beginRows() {
    beginSources();
    [[unroll]] for (uint row = 0u; row < kRows; ++row) {
        sums[row] = vec3(kOneSource ? 0.0 : 1.0);
        lost[row] = radiances[row] = vec3(0);
    }
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
    vec3 source = findSource(row, sphere.medium);
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
