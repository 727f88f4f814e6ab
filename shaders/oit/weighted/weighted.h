// SPDX-License-Identifier: Apache-2.0
// Weighted sums over layers: constants and bindings; C++ and GLSL.
#ifndef BRUME_SHADERS_OIT_WEIGHTED_H
#define BRUME_SHADERS_OIT_WEIGHTED_H
#include "../layers/layers.h"

BRUME_STRUCTS_BEGIN

// Specialization constants of the layer shaders, from kLayerConstantOwn on.
BRUME_CONST uint kWeightedSplit = 4u;       // bool: depths as a coarse and a fine sum
BRUME_CONST uint kWeightedPower = 5u;       // float: weight = (distance / t)^power, kept in bounds
BRUME_CONST uint kWeightedDistance = 6u;    // float, m: where the weight is 1
BRUME_CONST uint kWeightedMaxWeight = 7u;   // float
BRUME_CONST uint kWeightedDiffusion = 8u;   // bool
BRUME_CONST uint kWeightedRefraction = 9u;  // bool
BRUME_CONST uint kWeightedBlurWidth = 10u;  // float, m: k0 of eq. 6
BRUME_CONST uint kWeightedBlurReach = 11u;  // float, m: k1 of eq. 7
BRUME_CONST uint kWeightedBehind = 12u;     // float, m: delta z of eq. 9
BRUME_CONST uint kWeightedPacked = 13u;     // bool: the formats of the paper

// Specialization constants of the resolve.
BRUME_CONST uint kResolveColoured = 0u;
BRUME_CONST uint kResolveSplit = 1u;
BRUME_CONST uint kResolveDiffusion = 2u;
BRUME_CONST uint kResolveRefraction = 3u;
BRUME_CONST uint kResolveSelfModulation = 4u;  // float in [0, 1]: 0.5 is eq. 13
BRUME_CONST uint kResolveScale = 5u;           // of the media's targets, 1: they have none
BRUME_CONST uint kResolveTaps = 6u;            // of the gather; 0: all of the disk
BRUME_CONST uint kResolvePacked = 7u;          // bool

// Bindings of the resolve.
BRUME_CONST uint kBindingWeightedSum = 8u;        // sum of w (radiance, loss)
BRUME_CONST uint kBindingWeightedDepth = 9u;      // sum of -ln(transmittance); packed: the product
BRUME_CONST uint kBindingWeightedFine = 10u;      // its fine part, where coloured
BRUME_CONST uint kBindingWeightedOffset = 11u;    // sum of coverage (offset in pixels, 1, distance)
BRUME_CONST uint kBindingWeightedLowSum = 12u;    // of the media at low resolution
BRUME_CONST uint kBindingWeightedLowDepth = 13u;
BRUME_CONST uint kBindingWeightedLowFine = 14u;

// Coarse sums are multiples of 2^-16: exact in fp32 up to 256, whatever the order.
BRUME_CONST float kCoarseStep = 1.0f / 65536.0f;
BRUME_CONST float kMaxBlur = 48.0f;  // standard deviation, pixels
BRUME_CONST float kPackedOffset = 64.0f;  // pixels, the largest sum of offsets that is packed

BRUME_STRUCTS_END
#endif
