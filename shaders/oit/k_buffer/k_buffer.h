// SPDX-License-Identifier: Apache-2.0
// The nearest K layers of each pixel: layout and bindings; C++ and GLSL.
#ifndef BRUME_SHADERS_OIT_K_BUFFER_H
#define BRUME_SHADERS_OIT_K_BUFFER_H
#include "../layers/layers.h"

BRUME_STRUCTS_BEGIN

// The buffer holds uint64_t keys[pixels][K], ascending, then KLayer layers[pixels][K]. A key is the
// bits of the distance and, below, the primitive's id: no two layers tie.
struct KLayer {
    vec3 radiance;
    vec3 loss;
};

BRUME_CONST uint kKBufferLayers = 4u;           // specialization constant of the layer shaders: K
BRUME_CONST uint kKBufferResolveLayers = 0u;    // of the resolve
BRUME_CONST uint kKBufferResolveColoured = 1u;

BRUME_CONST uint kBindingTailSum = 8u;    // sum of (radiance, loss) of the layers behind
BRUME_CONST uint kBindingTailDepth = 9u;  // sum of -ln(transmittance)

struct KResolvePush {
    uint64_t data;
};

BRUME_STRUCTS_END
#endif
