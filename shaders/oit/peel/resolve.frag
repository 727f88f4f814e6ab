// SPDX-License-Identifier: Apache-2.0
// The peeled layers before the background; what was not peeled is not there.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/frame_bindings.h"
#include "peel.h"

layout(binding = kBindingOpaqueColor) uniform sampler2D opaqueColor;
layout(binding = kBindingPeelRadiance) uniform sampler2D peeledRadiance;
layout(binding = kBindingPeelTransmittance) uniform sampler2D peeledTransmittance;
layout(location = 0) out vec4 result;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    result = vec4(texelFetch(peeledRadiance, pixel, 0).rgb +
                      texelFetch(peeledTransmittance, pixel, 0).rgb *
                          texelFetch(opaqueColor, pixel, 0).rgb,
                  1.0);
}
