// SPDX-License-Identifier: Apache-2.0
// The parameters of the effect as the block that the shared headers read. A storage buffer for the reason given at
// struct Tick: the parameters bound loops.
layout(set = 0, binding = kBindingEffect, scalar) readonly buffer EffectBlock {
    EffectParameters effect;
};
// Modules without use cost nothing: their loops vanish when the pipeline is compiled.
layout(constant_id = 1) const uint kCurlNoiseCount = 0u;

#define BRUME_EFFECT effect
#define BRUME_CURL_NOISE_COUNT kCurlNoiseCount
