// SPDX-License-Identifier: Apache-2.0
// Stochastic transparency: constants and bindings; C++ and GLSL.
#ifndef BRUME_SHADERS_OIT_STOCHASTIC_H
#define BRUME_SHADERS_OIT_STOCHASTIC_H
#include "../layers/layers.h"

BRUME_STRUCTS_BEGIN

// A pass keeps the nearest distance of each of its samples in the channels of RGBA32F images by
// minimum blending; coloured: first the images of red, then green, then blue.
BRUME_CONST uint kSamplesPerImage = 4u;
BRUME_CONST uint kMaxSampleImages = 6u;
BRUME_CONST float kNoSample = 3e38f;

// Specialization constants of the layer shaders, from kLayerConstantOwn on.
BRUME_CONST uint kStochasticSamples = 4u;    // of all passes together: a power of two up to 64
BRUME_CONST uint kStochasticImages = 5u;     // of each channel and pass
BRUME_CONST uint kStochasticNaive = 6u;      // bool
BRUME_CONST uint kStochasticSeed = 7u;       // kSeed...
BRUME_CONST uint kStochasticPattern = 8u;    // which noise
BRUME_CONST uint kStochasticWinners = 9u;    // bool: only what is nearest in a sample counts

BRUME_CONST uint kSeedPrimitive = 0u;
BRUME_CONST uint kSeedObject = 1u;
BRUME_CONST uint kSeedDepth = 2u;

// Specialization constants of the resolve.
BRUME_CONST uint kStochasticColoured = 0u;
BRUME_CONST uint kStochasticEstimator = 1u;  // kEstimator...

BRUME_CONST uint kEstimatorBasic = 0u;
BRUME_CONST uint kEstimatorAlpha = 1u;
BRUME_CONST uint kEstimatorDepth = 2u;
BRUME_CONST uint kEstimatorDepthAlpha = 3u;

// Bindings: of the gather the sample images, of the resolve the sums.
BRUME_CONST uint kBindingSamples = 17u;  // kMaxSampleImages of them
BRUME_CONST uint kBindingStochasticTotal = 8u;    // sum of -ln(transmittance)
BRUME_CONST uint kBindingStochasticSum = 9u;      // radiance seen; alpha: weights where not coloured
BRUME_CONST uint kBindingStochasticWeights = 10u; // per channel

BRUME_STRUCTS_END
#endif
