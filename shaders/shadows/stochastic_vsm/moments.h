// SPDX-License-Identifier: Apache-2.0
// Variance maps made of stochastic depths; C++ and GLSL.
#ifndef BRUME_SHADERS_SHADOWS_STOCHASTIC_VSM_MOMENTS_H
#define BRUME_SHADERS_SHADOWS_STOCHASTIC_VSM_MOMENTS_H
#include "../../common/shared.h"

BRUME_STRUCTS_BEGIN

// Where rays that nothing ends, and points behind all casters, are taken to be, in lengths of the
// casters' range. Far behind it two moments tell these rays from all others, so that the shadow
// behind everything is right whatever the depths of its casters. Chosen by us.
BRUME_CONST float kVsmFarEnd = 3.0f;
BRUME_CONST uint kVsmReduction = 4u;  // texels of the stochastic map per texel of moments

BRUME_STRUCTS_END

#ifndef __cplusplus
// A distance along the light in those lengths.
float vsmDepth(float distance, float begin, float end) {
    float z = (distance - begin) / (end - begin);
    return z < 1.0 ? max(z, 0.0) : kVsmFarEnd;
}
#endif
#endif
