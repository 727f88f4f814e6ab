// SPDX-License-Identifier: Apache-2.0
// A soft sphere on the GPU; C++ and GLSL.
#ifndef BRUME_SHADERS_COMMON_SPHERE_H
#define BRUME_SHADERS_COMMON_SPHERE_H
#include "shared.h"

BRUME_STRUCTS_BEGIN

struct SphereData {
    vec3 center;    // m, relative to the camera
    vec3 centerLo;  // what rounding has taken from it
    float radius;   // m; <= 0: nothing there
    vec3 tint;      // multiplies albedo and emission
    float density;  // multiplies extinction, scattering and emission
    uint medium;    // index into the media
    uint id;        // unique, stable when the order changes
    uint profile;   // kProfileConstant or kProfileSmooth
    uint shares;    // its number among spheres shadowed as a whole (shadows/spheres), or kNoShares:
                    // shadows are asked for at each place
};

BRUME_CONST uint kNoShares = 0xffffffffu;

BRUME_CONST uint kProfileConstant = 0u;
BRUME_CONST uint kProfileSmooth = 1u;  // density (1 - r^2/R^2)^2

BRUME_STRUCTS_END

#ifdef __cplusplus
static_assert(sizeof(brume::shader::SphereData) == 60);
static_assert(offsetof(brume::shader::SphereData, tint) == 28);
#endif
#endif
