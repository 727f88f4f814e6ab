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
BRUME_CONST uint kStochasticSamples = 4u;    // in one mask: a power of two
BRUME_CONST uint kStochasticImages = 5u;     // of each channel and pass
BRUME_CONST uint kStochasticNaive = 6u;      // bool
BRUME_CONST uint kStochasticSeed = 7u;       // kSeed...
BRUME_CONST uint kStochasticPattern = 8u;    // which noise
BRUME_CONST uint kStochasticWinners = 9u;    // bool: only what is nearest in a sample counts
BRUME_CONST uint kStochasticAdaptive = 10u;  // bool: each pass has a mask of its own
BRUME_CONST uint kStochasticEdge = 11u;      // n: n x n pixels, one of the image, share a mask

BRUME_CONST uint kSeedPrimitive = 0u;
BRUME_CONST uint kSeedObject = 1u;
BRUME_CONST uint kSeedDepth = 2u;

// Specialization constants of what follows the layers.
BRUME_CONST uint kEstimateColoured = 0u;
BRUME_CONST uint kEstimateEstimator = 1u;  // kEstimator...
BRUME_CONST uint kEstimateAdaptive = 2u;   // bool
BRUME_CONST uint kEstimateError = 3u;      // float: at this standard error a pixel is done
BRUME_CONST uint kEstimateRadius = 4u;     // pixels, of the filter; 0: there is none

BRUME_CONST uint kEstimatorBasic = 0u;
BRUME_CONST uint kEstimatorAlpha = 1u;
BRUME_CONST uint kEstimatorDepth = 2u;
BRUME_CONST uint kEstimatorDepthAlpha = 3u;

// Bindings: of the gather the sample images, of what follows it the sums.
BRUME_CONST uint kBindingSamples = 17u;  // kMaxSampleImages of them
// Sum of -ln(transmittance); alpha: of the layers' radiance, for the filter.
BRUME_CONST uint kBindingStochasticTotal = 8u;
BRUME_CONST uint kBindingStochasticSum = 9u;       // radiance seen; alpha: weights where not coloured
BRUME_CONST uint kBindingStochasticWeights = 10u;  // per channel
// Adaptive: over the passes so far, sums of what each shows, with their number as alpha; and of
// their squares.
BRUME_CONST uint kBindingStochasticMeans = 11u;
BRUME_CONST uint kBindingStochasticSquares = 12u;
BRUME_CONST uint kBindingStochasticLayers = 13u;  // of the filter: what the layers send

struct StochasticCounters {
    uint passes;   // that pixels have taken part in, over all pixels
    uint unended;  // pixels whose standard error is still above the one asked for
};
struct StochasticResolvePush {
    uint64_t counters;  // StochasticCounters; adaptive only
};

BRUME_STRUCTS_END
#endif
