// SPDX-License-Identifier: Apache-2.0
// Media at low resolution: constants and bindings; C++ and GLSL.
#ifndef BRUME_SHADERS_OIT_UPSAMPLE_H
#define BRUME_SHADERS_OIT_UPSAMPLE_H
#include "../../common/shared.h"

BRUME_STRUCTS_BEGIN

BRUME_CONST uint kUpsampleScale = 0u;  // specialization constant: pixels per edge of a low texel
BRUME_CONST uint kBindingLowMedia = 8u;  // RGBA32F: radiance, share that is taken

BRUME_STRUCTS_END
#endif
