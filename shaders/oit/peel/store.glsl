// SPDX-License-Identifier: Apache-2.0
// Puts the layer behind those peeled so far; the depth test keeps the nearest of all that try.
#ifndef BRUME_OIT_PEEL_STORE_GLSL
#define BRUME_OIT_PEEL_STORE_GLSL
#include "../layers/layer.glsl"
#include "peel.h"

layout(binding = kBindingPeelRadiance) uniform sampler2D peeledRadiance;
layout(binding = kBindingPeelTransmittance) uniform sampler2D peeledTransmittance;
layout(location = 0) out vec4 radiance;
layout(location = 1) out vec4 remaining;

void storeLayer(Layer layer) {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 before = texelFetch(peeledRadiance, pixel, 0);
    vec3 through = texelFetch(peeledTransmittance, pixel, 0).rgb;
    float key = layerKey(layer);
    if (key <= before.a) discard;
    radiance = vec4(before.rgb + through * layer.radiance, key);
    remaining = vec4(through * (1.0 - layer.loss), 0.0);
    gl_FragDepth = 1.0 / (1.0 + key);  // reversed: keeps the digits of floats
}

#endif
