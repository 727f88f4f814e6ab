// SPDX-License-Identifier: Apache-2.0
// The layers' mean radiance, shared out by what they take from the background.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/exponential.glsl"
#include "../../common/frame_bindings.h"
#include "moment.h"

layout(binding = kBindingOpaqueColor) uniform sampler2D opaqueColor;
layout(binding = kBindingMomentSum) uniform sampler2D sums;
layout(binding = kBindingMomentDepth) uniform sampler2D totals;
layout(location = 0) out vec4 result;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 sum = texelFetch(sums, pixel, 0);
    vec3 depth = texelFetch(totals, pixel, 0).rgb, beta = exp(-depth);
    vec3 lost = max(depth * meanDecay(depth, beta), vec3(1e-7));
    float share = (lost.x + lost.y + lost.z) * (1.0 / 3.0);
    // 1 if the moments told the truth; bounded, because what glows has no part in it.
    float correction = sum.a > 0.0 ? clamp(share / sum.a, 0.25, 4.0) : 1.0;
    result = vec4(beta * texelFetch(opaqueColor, pixel, 0).rgb + sum.rgb * correction, 1.0);
}
