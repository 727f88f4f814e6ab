// SPDX-License-Identifier: Apache-2.0
// The colours of painted figures: errors, layers; C++ and GLSL.
#ifndef BRUME_SHADERS_COMMON_HEAT_H
#define BRUME_SHADERS_COMMON_HEAT_H
#include "shared_math.h"

BRUME_STRUCTS_BEGIN

BRUME_CONST float kHeatSteps = 6.0f;

// Black, blue, teal, green, yellow, red, white at 0 to 6, linear radiance between them.
BRUME_SHARED vec3 heatColor(float at) {
    vec3 below = vec3(0.0f), above = vec3(0.02f, 0.03f, 0.35f);
    float first = 0.0f;
    if (at >= 1.0f) { below = above; above = vec3(0.0f, 0.25f, 0.4f); first = 1.0f; }
    if (at >= 2.0f) { below = above; above = vec3(0.05f, 0.4f, 0.05f); first = 2.0f; }
    if (at >= 3.0f) { below = above; above = vec3(0.7f, 0.55f, 0.0f); first = 3.0f; }
    if (at >= 4.0f) { below = above; above = vec3(0.7f, 0.05f, 0.0f); first = 4.0f; }
    if (at >= 5.0f) { below = above; above = vec3(1.0f); first = 5.0f; }
    float share = at < 0.0f ? 0.0f : at > kHeatSteps ? 1.0f : at - first;
    return below + share * (above - below);
}

BRUME_STRUCTS_END
#endif
