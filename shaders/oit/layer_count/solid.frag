// SPDX-License-Identifier: Apache-2.0
// Solids, counted.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../layers/solid_layer.glsl"
#include "count.glsl"

void main() {
    Layer layer;
    countFragment(findSolidLayer(layer));
}
