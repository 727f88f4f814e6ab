// SPDX-License-Identifier: Apache-2.0
// Where the opaque surface of a pixel is, in passes that are made for a scene.
#ifndef BRUME_COMMON_OPAQUE_GLSL
#define BRUME_COMMON_OPAQUE_GLSL
#include "frame_bindings.h"

layout(constant_id = kConstantOpaque) const bool kOpaque = true;
layout(binding = kBindingOpaqueT) uniform sampler2D opaqueT;

// Along the ray, m.
float opaqueDistanceAt(ivec2 pixel) {
    return kOpaque ? texelFetch(opaqueT, pixel, 0).x : kNothingT;
}

// Whether something at distance t may be in front of it, for passes that work in single precision
// before others that work in double: some too many.
bool mayBeInFront(float t, ivec2 pixel) {
    const float kMargin = 1e-4;
    return !kOpaque || t < opaqueDistanceAt(pixel) * (1.0 + kMargin);
}

#endif
