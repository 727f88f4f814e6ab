// SPDX-License-Identifier: Apache-2.0
// What compositing along a ray carries along; C++ and GLSL.
#ifndef BRUME_SHADERS_OIT_INTEGRATE_PATH_H
#define BRUME_SHADERS_OIT_INTEGRATE_PATH_H
#include "../../common/shared.h"

BRUME_STRUCTS_BEGIN

// What a ray has met so far: everything that compositing front to back carries along.
struct Path {
    vec3 radiance;
    vec3 surfaces;    // product of the transmissions of the thin surfaces crossed
    vec3 surfacesLo;  // what rounding has taken from it
    vec3 depthHi;     // optical depth of the media crossed: T = surfaces * exp(-depth)
    vec3 depthLo;     // what rounding has taken from depthHi
    vec3 decay;       // exp(-depth)
};

// Sums over the solids that the ray is inside, or over the open media of constant density.
struct Sums {
    int count;
    vec3 extinctionHi, extinctionLo;
    vec3 sourceHi, sourceLo;  // of solids: scattering coefficient
};

BRUME_STRUCTS_END
#endif
