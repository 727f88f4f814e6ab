// SPDX-License-Identifier: Apache-2.0
// What the media send towards the pixels of a column, where light is the same everywhere: worked
// out once per ray.
#ifndef BRUME_OIT_TILE_COLUMN_LIGHT_GLSL
#define BRUME_OIT_TILE_COLUMN_LIGHT_GLSL
#include "../../common/lighting.glsl"
#include "column.glsl"

// Radiance per metre of a medium of density 1, without shadows, and of a sphere that is shadowed as
// a whole.
vec3 sources[kRows * kTileMedia];
vec3 sphereSources[kRows];
MediumData loadMedium(uint m) { return media[kOneSource ? spheres[0].medium : m]; }

void beginSources() {
    [[unroll]] for (uint i = 0u; i < kRows * kTileMedia; ++i) sources[i] = frame.ambient;
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

// Of density and tint 1; findSphereSources() must have been called where spheres have shadows.
vec3 findSource(uint row, uint mediumIndex) {
    if (kWholeShadows) return sphereSources[row];
    vec3 source = sources[row * kTileMedia];
    [[unroll]] for (uint m = 1u; m < kMediumCount; ++m) source =
        mediumIndex == m ? sources[row * kTileMedia + m] : source;
    return source;
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

#endif
