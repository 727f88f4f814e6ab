// SPDX-License-Identifier: Apache-2.0
// The four estimators of Enderton et al. 2011: from the sums of a pixel to what it shows.
#ifndef BRUME_OIT_STOCHASTIC_ESTIMATE_GLSL
#define BRUME_OIT_STOCHASTIC_ESTIMATE_GLSL
#include "../../common/bindings.glsl"
#include "../../common/exponential.glsl"
#include "stochastic.h"

layout(constant_id = kEstimateColoured) const bool kColoured = true;
layout(constant_id = kEstimateEstimator) const uint kEstimator = kEstimatorDepthAlpha;
layout(constant_id = kEstimateError) const float kError = 0.0;
layout(binding = kBindingOpaqueT) uniform sampler2D opaqueT;
layout(binding = kBindingOpaqueColor) uniform sampler2D opaqueColor;
layout(binding = kBindingStochasticTotal) uniform sampler2D totals;

struct Estimate {
    vec3 layers;  // the radiance that they send
    vec3 behind;  // the share of the background's that they let through
};

vec3 lossOf(vec3 depth) { return depth * meanDecay(depth, exp(-depth)); }

// `weights`: those of the samples in which anything was seen.
Estimate estimateFrom(vec3 depth, vec3 radiance, vec3 weights) {
    if (kEstimator == kEstimatorBasic) return Estimate(radiance, 1.0 - weights);
    Estimate estimate = Estimate(radiance, exp(-depth));
    if (kEstimator == kEstimatorDepth) return estimate;
    // Alpha correction: what was seen stands for all that is there.
    vec3 loss = max(lossOf(depth), vec3(1e-7));
    estimate.layers = mix(vec3(0), radiance * loss / max(weights, vec3(1e-30)),
                          greaterThan(weights, vec3(0)));
    return estimate;
}

vec3 compose(Estimate estimate, ivec2 pixel) {
    return estimate.layers + estimate.behind * texelFetch(opaqueColor, pixel, 0).rgb;
}

#endif
