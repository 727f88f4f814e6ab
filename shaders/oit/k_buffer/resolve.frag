// SPDX-License-Identifier: Apache-2.0
// The nearest K layers in their order, the mean of the rest behind them, then the background.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/exponential.glsl"
#include "slots.glsl"

layout(push_constant, scalar) uniform Push { KResolvePush push; };
layout(constant_id = kKBufferResolveLayers) const uint kLayers = 8u;
layout(binding = kBindingOpaqueColor) uniform sampler2D opaqueColor;
layout(binding = kBindingTailSum) uniform sampler2D tailSums;
layout(binding = kBindingTailDepth) uniform sampler2D tailDepths;
layout(location = 0) out vec4 result;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    uint first = firstSlot(kLayers);
    vec3 radiance = vec3(0), through = vec3(1);
    for (uint i = 0u; i < kLayers && KeyArray(push.data).at[first + i] != kNoKey; ++i) {
        KLayer layer = layersBehind(push.data, kLayers).at[first + i];
        radiance += through * layer.radiance;
        through *= 1.0 - layer.loss;
    }
    vec4 sum = texelFetch(tailSums, pixel, 0);
    vec3 depth = texelFetch(tailDepths, pixel, 0).rgb, beta = exp(-depth);
    vec3 lost = depth * meanDecay(depth, beta);
    vec3 tail = sum.rgb / max(sum.a, 1e-30) * ((lost.x + lost.y + lost.z) * (1.0 / 3.0));
    result = vec4(radiance + through * (tail + beta * texelFetch(opaqueColor, pixel, 0).rgb), 1.0);
}
