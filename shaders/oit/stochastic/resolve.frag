// SPDX-License-Identifier: Apache-2.0
// The four estimators of Enderton et al. 2011.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/bindings.glsl"
#include "../../common/exponential.glsl"
#include "stochastic.h"

layout(constant_id = kStochasticColoured) const bool kColoured = true;
layout(constant_id = kStochasticEstimator) const uint kEstimator = kEstimatorDepthAlpha;
layout(binding = kBindingOpaqueT) uniform sampler2D opaqueT;
layout(binding = kBindingOpaqueColor) uniform sampler2D opaqueColor;
layout(binding = kBindingStochasticTotal) uniform sampler2D totals;
layout(binding = kBindingStochasticSum) uniform sampler2D sums;
layout(binding = kBindingStochasticWeights) uniform sampler2D weightSums;
layout(location = 0) out vec4 result;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 sum = texelFetch(sums, pixel, 0);
    vec3 total = texelFetch(totals, pixel, 0).rgb;
    vec3 weights = kColoured ? texelFetch(weightSums, pixel, 0).rgb : sum.aaa;
    vec3 behind = exp(-total), loss = total * meanDecay(total, behind);
    vec3 radiance = sum.rgb;
    if (kEstimator == kEstimatorBasic) {
        behind = 1.0 - weights;
    } else if (kEstimator != kEstimatorDepth) {
        // Alpha correction: what was seen stands for all that is there.
        loss = max(loss, vec3(1e-7));
        radiance = mix(vec3(0), sum.rgb * loss / max(weights, vec3(1e-30)),
                       greaterThan(weights, vec3(0)));
    }
    result = vec4(radiance + behind * texelFetch(opaqueColor, pixel, 0).rgb, 1.0);
}
