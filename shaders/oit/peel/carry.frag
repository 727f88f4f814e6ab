// SPDX-License-Identifier: Apache-2.0
// Where no layer is left to peel, the last state stays: it is drawn behind all layers.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "peel.h"

layout(binding = kBindingPeelRadiance) uniform sampler2D peeledRadiance;
layout(binding = kBindingPeelTransmittance) uniform sampler2D peeledTransmittance;
layout(location = 0) out vec4 radiance;
layout(location = 1) out vec4 remaining;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    radiance = texelFetch(peeledRadiance, pixel, 0);
    remaining = texelFetch(peeledTransmittance, pixel, 0);
    gl_FragDepth = 0.0;
}
