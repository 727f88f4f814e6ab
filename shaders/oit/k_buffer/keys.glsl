// SPDX-License-Identifier: Apache-2.0
// Keeps the K smallest keys of a pixel, sorted: what a slot gives up goes on to the next one. The
// outcome does not depend on the order of arrival.
#ifndef BRUME_OIT_K_BUFFER_KEYS_GLSL
#define BRUME_OIT_K_BUFFER_KEYS_GLSL
#extension GL_EXT_shader_atomic_int64 : require
#include "../layers/layer.glsl"
#include "slots.glsl"

layout(constant_id = kKBufferLayers) const uint kLayers = 8u;

uint64_t packKey(Layer layer) {
    return uint64_t(floatBitsToUint(layerKey(layer))) << 32 | uint64_t(layer.primitive);
}

void storeLayer(Layer layer) {
    uint64_t key = packKey(layer);
    uint first = firstSlot(kLayers);
    for (uint i = 0u; i < kLayers && key != kNoKey; ++i)
        key = max(key, atomicMin(KeyArray(push.data).at[first + i], key));
}

#endif
