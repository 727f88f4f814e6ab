// SPDX-License-Identifier: Apache-2.0
// Depth peeling: bindings; C++ and GLSL.
#ifndef BRUME_SHADERS_OIT_PEEL_H
#define BRUME_SHADERS_OIT_PEEL_H
#include "../layers/layers.h"

BRUME_STRUCTS_BEGIN

// What the layers peeled so far have left.
BRUME_CONST uint kBindingPeelRadiance = 17u;       // alpha: key of the last one, < 0: none
BRUME_CONST uint kBindingPeelTransmittance = 18u;

BRUME_STRUCTS_END
#endif
