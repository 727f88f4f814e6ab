// SPDX-License-Identifier: Apache-2.0
// Adds the moments of a layer's optical depth over its place.
#ifndef BRUME_OIT_MOMENT_STORE_GLSL
#define BRUME_OIT_MOMENT_STORE_GLSL
#include "place.glsl"

layout(location = 0) out vec4 total;
layout(location = 1) out vec4 low;
layout(location = 2) out vec4 high;

void storeLayer(Layer layer) {
    vec3 z = placesOf(layer), z2 = z * z, z4 = z2 * z2;
    float depth = kColoured ? meanOf(layer.depth) : layer.depth.x;
    vec3 weights = kPlaceWeights * depth;
    total = vec4(layer.depth, depth);
    low = vec4(dot(weights, z), dot(weights, z2), dot(weights, z2 * z), dot(weights, z4));
    high = kMoments > 4u ? vec4(dot(weights, z4 * z), dot(weights, z4 * z2),
                                dot(weights, z4 * z2 * z), dot(weights, z4 * z4))
                         : vec4(0);
}

#endif
