// SPDX-License-Identifier: Apache-2.0
// Solids of method k_buffer: keys.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../layers/solid_layer.glsl"
#include "keys.glsl"

void main() {
    Layer layer;
    if (!findSolidLayer(layer)) discard;
    storeLayer(layer);
}
