// SPDX-License-Identifier: Apache-2.0
// Thin surfaces, counted.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../layers/surface_layer.glsl"
#include "count.glsl"

void main() {
    Layer layer;
    SurfacePoint point;
    countFragment(findSurfaceLayer(layer, point));
}
