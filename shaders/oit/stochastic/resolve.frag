// SPDX-License-Identifier: Apache-2.0
// What a pixel shows, from the sums of all passes; where a filter follows, only what its layers send.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "estimate.glsl"
#include "variance.glsl"
#include "../../gpu/address.glsl"

layout(constant_id = kEstimateAdaptive) const bool kAdaptive = false;
layout(constant_id = kEstimateRadius) const uint kRadius = 0u;
layout(binding = kBindingStochasticSum) uniform sampler2D sums;
layout(binding = kBindingStochasticWeights) uniform sampler2D weightSums;
layout(buffer_reference, scalar) buffer CounterBlock { StochasticCounters counters; };
layout(push_constant, scalar) uniform Push { StochasticResolvePush push; };
layout(location = 0) out vec4 result;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 sum = texelFetch(sums, pixel, 0);
    vec3 weights = kColoured ? texelFetch(weightSums, pixel, 0).rgb : sum.aaa;
    if (kAdaptive) {
        float passes = texelFetch(means, pixel, 0).a;
        sum /= passes;
        weights /= passes;
        atomicAdd(CounterBlock(push.counters).counters.passes, uint(passes));
        if (!isErrorReached(pixel)) atomicAdd(CounterBlock(push.counters).counters.unended, 1u);
    }
    Estimate estimate = estimateFrom(texelFetch(totals, pixel, 0).rgb, sum.rgb, weights);
    result = vec4(kRadius > 0u ? estimate.layers : compose(estimate, pixel), 1.0);
}
