// SPDX-License-Identifier: Apache-2.0
// Variance maps made of stochastic depths; C++ and GLSL.
#ifndef BRUME_SHADERS_SHADOWS_STOCHASTIC_VSM_MOMENTS_H
#define BRUME_SHADERS_SHADOWS_STOCHASTIC_VSM_MOMENTS_H
#include "../../common/shared.h"

BRUME_STRUCTS_BEGIN

BRUME_CONST uint kVsmReduction = 4u;  // texels of the stochastic map per texel of moments

BRUME_STRUCTS_END
#endif
