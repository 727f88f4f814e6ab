// SPDX-License-Identifier: Apache-2.0
// Leaves the distance of a layer in the samples that it covers.
#ifndef BRUME_OIT_STOCHASTIC_STORE_GLSL
#define BRUME_OIT_STOCHASTIC_STORE_GLSL
#include "samples.glsl"

layout(location = 0) out vec4 total;
layout(location = 1) out vec4 distances[kMaxSampleImages];

void storeLayer(Layer layer) {
    total = vec4(layer.depth, meanOf(layer.radiance));
    Noise noise = makeNoise(layer);
    for (uint i = 0u; i < kMaxSampleImages; ++i) distances[i] = vec4(kNoSample);
    for (uint i = 0u; i < kImages; ++i) {
        vec4 thresholds = sampleThresholds(noise, firstGroup() + i);
        for (uint c = 0u; c < (kColoured ? 3u : 1u); ++c)
            distances[c * kImages + i] =
                mix(vec4(kNoSample), sampleDistances(layer, c, thresholds),
                    coveredSamples(layer, c, thresholds));
    }
}

#endif
