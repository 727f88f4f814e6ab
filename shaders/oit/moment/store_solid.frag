// SPDX-License-Identifier: Apache-2.0
// Solids of method moment: store.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../layers/solid_layer.glsl"
#include "store.glsl"

void main() {
    Layer layer;
    if (!findSolidLayer(layer)) discard;
    storeLayer(layer);
}
