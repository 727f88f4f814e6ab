// SPDX-License-Identifier: Apache-2.0
// Which samples a layer covers, and at which distance: the same in the pass that stores distances
// and in the one that gathers radiance.
#ifndef BRUME_OIT_STOCHASTIC_SAMPLES_GLSL
#define BRUME_OIT_STOCHASTIC_SAMPLES_GLSL
#include "../../common/random.h"
#include "../layers/layer.glsl"
#include "stochastic.h"

layout(constant_id = kStochasticSamples) const uint kSamples = 4u;
layout(constant_id = kStochasticImages) const uint kImages = 1u;
layout(constant_id = kStochasticNaive) const bool kNaive = false;
layout(constant_id = kStochasticSeed) const uint kSeed = kSeedPrimitive;
layout(constant_id = kStochasticPattern) const uint kPattern = 0u;
layout(constant_id = kStochasticAdaptive) const bool kAdaptive = false;
layout(constant_id = kStochasticEdge) const uint kEdge = 1u;

// All orders of 0 1 2 3, two bits each.
const uint kOrders[24] = uint[24](0xe4u, 0xb4u, 0xd8u, 0x78u, 0x9cu, 0x6cu, 0xe1u, 0xb1u, 0xc9u,
                                  0x39u, 0x8du, 0x2du, 0xd2u, 0x72u, 0xc6u, 0x36u, 0x4eu, 0x1eu,
                                  0x93u, 0x63u, 0x87u, 0x27u, 0x4bu, 0x1bu);

struct Noise {
    uvec3 key;   // hash of pixel and seed
    float shift;  // xi of R = floor(alpha S + xi)
};

Noise makeNoise(Layer layer) {
    uint seed = kSeed == kSeedPrimitive ? layer.primitive
                : kSeed == kSeedObject  ? layer.object
                                        : floatBitsToUint(layer.t.x);
    uvec2 pixel = uvec2(gl_FragCoord.xy) / kEdge;
    Noise noise;
    noise.key = pcg3d(uvec3(pixel.x | pixel.y << 16u, seed, kPattern));
    if (kAdaptive) noise.key = pcg3d(noise.key + push.step);
    noise.shift = unitFloat(pcg3d(noise.key).x);
    return noise;
}

// Four samples are covered by a layer whose loss is at least these thresholds. Stratified: sample s
// has rank r in a random order of all samples, and R = floor(alpha S + xi) of them are covered:
// r < R where alpha >= (r + 1 - xi) / S. Groups of four get orders of their own and take turns, so
// that R is spread evenly over them. Nothing is quantised: alpha = 1e-6 covers one sample in 1e6 / S
// pixels.
vec4 sampleThresholds(Noise noise, uint group) {
    uvec3 words = pcg3d(noise.key ^ uvec3(group * 0x9e3779b9u, 0x85ebca6bu, group));
    vec4 thresholds;
    if (kNaive) {
        thresholds = vec4(unitFloat(words.x), unitFloat(words.y), unitFloat(words.z),
                          unitFloat(pcg3d(words).x));
    } else {
        uint high, low;
        umulExtended(words.x, 24u, high, low);
        uvec4 rank = (uvec4(kOrders[high]) >> uvec4(0u, 2u, 4u, 6u)) & 3u;
        if (kSamples == 2u) rank = uvec4(0u, 1u, 0u, 1u) ^ (words.y >> 31u);
        if (kSamples == 1u) rank = uvec4(0u);
        uint groups = max(kSamples / 4u, 1u);
        // In which turn this group gets the sample of each rank: an order that differs from rank to
        // rank and from layer to layer in more than a shift, or their samples would go together.
        uvec4 turns = uvec4(noise.key.y) >> (rank * 8u);
        uvec4 turn = ((uvec4(group) ^ turns >> 4u) & (groups - 1u)) * (turns & 14u | 1u);
        turn = (turn + (uvec4(noise.key.z) >> (rank * 8u))) & (groups - 1u);
        thresholds = (vec4(rank * groups + turn) + (1.0 - noise.shift)) / float(kSamples);
    }
    // With fewer than four samples each stands in more than one channel.
    return kSamples == 1u ? thresholds.xxxx : kSamples == 2u ? thresholds.xyxy : thresholds;
}

bvec4 coveredSamples(Layer layer, uint channel, vec4 thresholds) {
    return greaterThanEqual(vec4(layer.loss[channel]), thresholds);
}

// The distance at which a layer would stop light in each sample: in a medium where its loss so far
// reaches the threshold, which is a free flight, so that overlapping media come out right in
// expectation. Samples that are not covered get one as well, from what is left of the threshold.
vec4 sampleDistances(Layer layer, uint channel, vec4 thresholds) {
    if (layer.t.x == layer.t.y) return layer.t.xxxx;
    float loss = layer.loss[channel];
    vec4 spare = (thresholds - loss) * (loss / max(1.0 - loss, 1e-7));
    vec4 flight = mix(spare, thresholds, coveredSamples(layer, channel, thresholds));
    return findShares(layer,
                      min(depthFromLoss(flight) / max(layer.depth[channel], 1e-30), vec4(1.0)));
}

// Groups of four samples: those of earlier passes come before this one's, and those of a pixel's
// earlier sub-pixels before this sub-pixel's.
uint firstGroup() {
    uvec2 place = uvec2(gl_FragCoord.xy) % kEdge;
    uint groups = max(kSamples / 4u, 1u) / (kEdge * kEdge);
    return (place.y * kEdge + place.x) * groups + (kAdaptive ? 0u : push.step * kImages);
}

// What one sample of a pixel stands for.
float sampleShare() { return float(kEdge * kEdge) / float(max(kSamples, 4u)); }

#endif
