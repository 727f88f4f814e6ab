// SPDX-License-Identifier: Apache-2.0
// Media of method k_buffer: store.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../layers/medium_layer.glsl"
#include "store.glsl"

void main() {
    Layer layer;
    if (!findMediumLayer(layer)) discard;
    storeLayer(layer);
}
