// SPDX-License-Identifier: Apache-2.0
// Adds the radiance of a layer by the share of samples in which it is seen.
#ifndef BRUME_OIT_STOCHASTIC_GATHER_GLSL
#define BRUME_OIT_STOCHASTIC_GATHER_GLSL
#include "samples.glsl"

layout(constant_id = kStochasticWinners) const bool kWinners = false;
layout(binding = kBindingSamples + 0u) uniform sampler2D samples0;
layout(binding = kBindingSamples + 1u) uniform sampler2D samples1;
layout(binding = kBindingSamples + 2u) uniform sampler2D samples2;
layout(binding = kBindingSamples + 3u) uniform sampler2D samples3;
layout(binding = kBindingSamples + 4u) uniform sampler2D samples4;
layout(binding = kBindingSamples + 5u) uniform sampler2D samples5;
layout(location = 0) out vec4 sum;
layout(location = 1) out vec4 weights;

vec4 readSamples(uint image) {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    switch (image) {  // arrays of samplers want constant indices on some devices
        case 0u: return texelFetch(samples0, pixel, 0);
        case 1u: return texelFetch(samples1, pixel, 0);
        case 2u: return texelFetch(samples2, pixel, 0);
        case 3u: return texelFetch(samples3, pixel, 0);
        case 4u: return texelFetch(samples4, pixel, 0);
    }
    return texelFetch(samples5, pixel, 0);
}

// In how many samples of the pass the layer is seen, per channel.
vec3 countSeen(Layer layer) {
    Noise noise = makeNoise(layer);
    vec3 seen = vec3(0);
    for (uint i = 0u; i < kImages; ++i) {
        vec4 thresholds = sampleThresholds(noise, firstGroup() + i);
        for (uint c = 0u; c < (kColoured ? 3u : 1u); ++c) {
            vec4 nearest = readSamples(c * kImages + i);
            vec4 t = sampleDistances(layer, c, thresholds);
            vec4 isSeen = vec4(greaterThanEqual(nearest, t));
            if (kWinners)
                isSeen = vec4(equal(nearest, t)) * vec4(coveredSamples(layer, c, thresholds));
            seen[c] += dot(isSeen, vec4(1));
        }
    }
    return kColoured ? seen : seen.xxx;
}

void storeLayer(Layer layer) {
    vec3 seen = countSeen(layer) * sampleShare();
    // What only glows counts as a very thin layer.
    vec3 loss = mix(layer.loss, vec3(1e-7), lessThan(layer.loss, vec3(1e-7)));
    vec3 weight = kWinners ? seen : seen * loss;
    sum.rgb = kWinners ? seen * layer.radiance / loss : seen * layer.radiance;
    sum.a = weight.x;
    weights = vec4(weight, 0.0);
}

#endif
