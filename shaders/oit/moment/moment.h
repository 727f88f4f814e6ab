// SPDX-License-Identifier: Apache-2.0
// Moments of optical depth: constants and bindings; C++ and GLSL.
#ifndef BRUME_SHADERS_OIT_MOMENT_H
#define BRUME_SHADERS_OIT_MOMENT_H
#include "../layers/layers.h"

BRUME_STRUCTS_BEGIN

BRUME_CONST uint kMomentCount = 4u;  // specialization constant of the layer shaders: 4, 6 or 8
BRUME_CONST uint kMomentBias = 5u;   // float

// Of the layer shaders.
BRUME_CONST uint kBindingMomentRange = 17u;  // RG32F: -distance of the nearest, of the farthest
BRUME_CONST uint kBindingMomentTotal = 18u;  // sum of depths; alpha: of their mean
BRUME_CONST uint kBindingMomentLow = 19u;    // moments 1 to 4, times the depth
BRUME_CONST uint kBindingMomentHigh = 20u;   // 5 to 8
// Of the resolve.
BRUME_CONST uint kBindingMomentSum = 8u;
BRUME_CONST uint kBindingMomentDepth = 9u;

BRUME_STRUCTS_END
#endif
