// SPDX-License-Identifier: Apache-2.0
// Thin surfaces of method peel: store.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../layers/surface_layer.glsl"
#include "store.glsl"

void main() {
    Layer layer;
    SurfacePoint point;
    if (!findSurfaceLayer(layer, point)) discard;
    storeLayer(layer);
}
