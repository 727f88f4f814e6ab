// SPDX-License-Identifier: Apache-2.0
// LDR-FLIP: how strongly an observer who flips between two images sees them differ.
//
// Source: Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild, "FLIP: A Difference
//   Evaluator for Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020,
//   DOI 10.1145/3406183.
// Equations: section 4.1 (spatial filtering) -> filterByContrastSensitivity(); 4.1.2 (Hunt-adjusted
//   HyAB distance and its redistribution) -> colorDifference(); 4.2 (edges and points) ->
//   featureDifference(); section 4.3 (their combination) -> computeFlip().
// Differs: the filters are applied as sums of separable Gaussians, which gives the same weights.
// Cost: about 250 multiplications per pixel and image at 67 pixels per degree.
#pragma once

#include <core/image.hpp>

#include <vector>

namespace brume::bench {

/// 0.7 m from a screen 0.7 m wide with 3840 pixels, the paper's default.
inline constexpr double kDefaultPixelsPerDegree = 67.0206;

/// Per-pixel FLIP in [0, 1], row-major from the top left. Both images are linear RGB of the same
/// size; values are clamped to [0, 1], so tone-map first. Every value must be finite.
std::vector<float> computeFlip(const Image& test, const Image& reference,
                               double pixelsPerDegree = kDefaultPixelsPerDegree);

}  // namespace brume::bench
