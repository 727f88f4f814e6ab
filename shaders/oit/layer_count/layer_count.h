// SPDX-License-Identifier: Apache-2.0
// Counting layers; C++ and GLSL.
#ifndef BRUME_SHADERS_OIT_LAYER_COUNT_H
#define BRUME_SHADERS_OIT_LAYER_COUNT_H
#include "../layers/layers.h"

BRUME_STRUCTS_BEGIN

BRUME_CONST uint kBindingLayerCount = 17u;
// bool: fragments that meet nothing count as well
BRUME_CONST uint kLayerCountConstantMisses = kLayerConstantOwn;
// What is painted white.
BRUME_CONST float kLargestLayerCount = 1024.0f;

BRUME_STRUCTS_END
#endif
