// SPDX-License-Identifier: Apache-2.0
// Where the keys and layers of a pixel are.
#ifndef BRUME_OIT_K_BUFFER_SLOTS_GLSL
#define BRUME_OIT_K_BUFFER_SLOTS_GLSL
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "../../common/bindings.glsl"
#include "k_buffer.h"

layout(buffer_reference, scalar) buffer KeyArray { uint64_t at[]; };
layout(buffer_reference, scalar) buffer KLayerArray { KLayer at[]; };

const uint64_t kNoKey = 0xffffffffffffffffUL;

uint firstSlot(uint layers) {
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    return (pixel.y * frame.size.x + pixel.x) * layers;
}

KLayerArray layersBehind(uint64_t data, uint layers) {
    return KLayerArray(data + uint64_t(frame.size.x * frame.size.y) * uint64_t(layers * 8u));
}

#endif
