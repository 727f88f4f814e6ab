// SPDX-License-Identifier: Apache-2.0
// Stores a layer at its key's place, or adds it to the tail: sums, whose order does not matter.
#ifndef BRUME_OIT_K_BUFFER_STORE_GLSL
#define BRUME_OIT_K_BUFFER_STORE_GLSL
#include "../layers/layer.glsl"
#include "slots.glsl"

layout(constant_id = kKBufferLayers) const uint kLayers = 8u;
layout(location = 0) out vec4 tailSum;
layout(location = 1) out vec4 tailDepth;

void storeLayer(Layer layer) {
    uint64_t key = uint64_t(floatBitsToUint(layerKey(layer))) << 32 | uint64_t(layer.primitive);
    uint first = firstSlot(kLayers), slot = 0u;
    while (slot < kLayers && KeyArray(push.data).at[first + slot] < key) ++slot;
    bool isTail = slot == kLayers || KeyArray(push.data).at[first + slot] != key;
    if (!isTail)
        layersBehind(push.data, kLayers).at[first + slot] = KLayer(layer.radiance, layer.loss);
    float loss = max(kColoured ? meanOf(layer.loss) : layer.loss.x, 1e-7);
    tailSum = isTail ? vec4(layer.radiance, loss) : vec4(0);
    tailDepth = isTail ? vec4(max(layer.depth, vec3(1e-7)), 0.0) : vec4(0);
}

#endif
