// SPDX-License-Identifier: Apache-2.0
// Adds a layer to the sums of its pixel.
#ifndef BRUME_OIT_WEIGHTED_STORE_GLSL
#define BRUME_OIT_WEIGHTED_STORE_GLSL
#include "../layers/layer.glsl"
#include "weighted.h"

layout(constant_id = kWeightedSplit) const bool kSplit = false;
layout(constant_id = kWeightedPower) const float kPower = 3.0;
layout(constant_id = kWeightedDistance) const float kDistance = 1.0;
layout(constant_id = kWeightedMaxWeight) const float kMaxWeight = 1e12;
layout(constant_id = kWeightedRefraction) const bool kRefraction = false;
layout(constant_id = kWeightedPacked) const bool kPacked = false;

layout(location = 0) out vec4 sum;
layout(location = 1) out vec4 depthSum;  // colours and squared blur, or coarse and fine
layout(location = 2) out vec4 extra;     // the offset, or the fine sum
layout(location = 3) out vec4 extra2;    // the fine sum where there is an offset

// By view distance: depth-buffer values depend on near and far. A power law knows no scale.
float weightAt(float t) {
    float nearness = kDistance / max(t, 1e-9);
    float weight = kPower == 2.0 ? nearness * nearness : exp2(kPower * log2(nearness));
    return clamp(weight, 1.0 / kMaxWeight, kMaxWeight);
}

// `offset`: coverage times (refraction in pixels, 1, distance); `blur2`: squared pixels.
void storeWeighted(Layer layer, vec4 offset, float blur2) {
    float loss = kColoured ? meanOf(layer.loss) : layer.loss.x;
    // What only glows counts as a very thin layer: else its share of the loss is 0 / 0.
    if (loss < 1e-7 && layer.radiance != vec3(0)) {
        loss = 1e-7;
        layer.depth = max(layer.depth, vec3(1e-7));
    }
    float w = weightAt(0.5 * (layer.t.x + layer.t.y));
    sum = vec4(w * layer.radiance, w * loss);
    vec3 coarse = kSplit ? round(layer.depth / kCoarseStep) * kCoarseStep : layer.depth;
    vec3 fine = layer.depth - coarse;
    depthSum = kColoured ? vec4(coarse, blur2) : vec4(coarse.x, fine.x, 0.0, 0.0);
    extra = kRefraction ? offset : vec4(fine, 0.0);
    extra2 = vec4(fine, 0.0);
    if (!kPacked) return;
    depthSum = vec4(1.0 - layer.loss, blur2 / (kMaxBlur * kMaxBlur));
    extra = vec4(offset.xy / kPackedOffset, 0.0, 0.0);
}

void storeLayer(Layer layer) { storeWeighted(layer, vec4(0), 0.0); }

#endif
