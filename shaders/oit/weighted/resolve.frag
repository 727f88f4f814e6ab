// SPDX-License-Identifier: Apache-2.0
// From the sums of a pixel to its radiance: eq. 3 of McGuire and Mara 2016.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/bindings.glsl"
#include "../../common/exponential.glsl"
#include "../upsample/joint_bilateral.glsl"
#include "weighted.h"

#include "background.glsl"

layout(constant_id = kResolveColoured) const bool kColoured = true;
layout(constant_id = kResolveSplit) const bool kSplit = false;
layout(constant_id = kResolveSelfModulation) const float kSelfModulation = 0.5;
layout(constant_id = kResolveScale) const uint kScale = 1u;
layout(binding = kBindingWeightedSum) uniform sampler2D sums;
layout(binding = kBindingWeightedFine) uniform sampler2D fineSums;
layout(binding = kBindingWeightedLowSum) uniform sampler2D lowSums;
layout(binding = kBindingWeightedLowDepth) uniform sampler2D lowDepthSums;
layout(binding = kBindingWeightedLowFine) uniform sampler2D lowFineSums;
layout(location = 0) out vec4 result;

// Coarse and fine sums come together last.
vec3 joinDepth(vec4 depth, vec4 fine) {
    if (!kColoured) return vec3(kSplit ? depth.x + depth.y : depth.x);
    return kSplit ? depth.rgb + fine.rgb : depth.rgb;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 sum = texelFetch(sums, pixel, 0), depth = texelFetch(depthSums, pixel, 0);
    vec4 fine = kColoured && kSplit ? texelFetch(fineSums, pixel, 0) : vec4(0);
    if (kScale > 1u) {
        LowTexels texels = findLowTexels(opaqueT, pixel, kScale);
        sum += readLow(lowSums, texels);
        vec4 low = readLow(lowDepthSums, texels);
        depth = kPacked ? vec4(depth.rgb * low.rgb, depth.a) : depth + low;
        if (kColoured && kSplit) fine += readLow(lowFineSums, texels);
    }
    // Nobody has touched it: nothing refracts or blurs either.
    vec4 nothing = !kPacked ? vec4(0) : kColoured ? vec4(1, 1, 1, 0) : vec4(1, 0, 0, 1);
    if (sum.a == 0.0 && depth == nothing && !kRefraction) {
        result = vec4(texelFetch(opaqueColor, pixel, 0).rgb, 1.0);
        return;
    }
    vec3 total = max(joinDepth(depth, fine), vec3(0));
    vec3 beta = kPacked ? total : exp(-total);
    vec3 lost = kPacked ? 1.0 - beta : total * meanDecay(total, beta);
    // Half-precision sums end at infinity.
    vec3 layers = min(sum.rgb, vec3(3e38)) / clamp(sum.a, 1e-37, 3e38);
    // Eq. 13: the layers filter each other by half of the hue with which all filter the background.
    float largest = max(beta.x, max(beta.y, beta.z));
    if (kColoured) layers *= 1.0 - kSelfModulation * (1.0 - beta / max(largest, 1e-20));
    float share = (lost.x + lost.y + lost.z) * (1.0 / 3.0);
    result = vec4(beta * backgroundAt(gl_FragCoord.xy) + share * layers, 1.0);
}
