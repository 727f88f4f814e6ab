// SPDX-License-Identifier: Apache-2.0
// The parameters of the effect as the uniform block that the shared headers read.
layout(set = 0, binding = kBindingEffect, scalar) uniform EffectBlock { EffectParameters effect; };
// Modules without use cost nothing: their loops vanish when the pipeline is compiled.
layout(constant_id = 1) const uint kCurlNoiseCount = 0u;

#define BRUME_EFFECT effect
#define BRUME_CURL_NOISE_COUNT kCurlNoiseCount
