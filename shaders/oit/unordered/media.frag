// SPDX-License-Identifier: Apache-2.0
// Media of method unordered.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../layers/medium_layer.glsl"
#include "store.glsl"

void main() {
    Layer layer;
    if (!findMediumLayer(layer)) discard;
    storeLayer(layer);
}
