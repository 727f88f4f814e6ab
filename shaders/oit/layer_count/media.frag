// SPDX-License-Identifier: Apache-2.0
// Media, counted.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../layers/medium_layer.glsl"
#include "count.glsl"

void main() {
    Layer layer;
    countFragment(findMediumLayer(layer));
}
