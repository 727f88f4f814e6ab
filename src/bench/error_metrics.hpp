// SPDX-License-Identifier: Apache-2.0
// How far one image is from another, in the figures that every comparison of Brume prints.
#pragma once

#include <core/image.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace brume::bench {

/// Differences test - reference in linear radiance, over the channels of all pixels that are
/// neither excluded nor non-finite. All zero (psnr infinite) if no pixel is left.
struct ErrorMetrics {
    double rmse = 0;  ///< root of the mean squared difference
    double max = 0;   ///< largest absolute difference
    double bias = 0;  ///< mean difference, with its sign
    double p999 = 0;  ///< 99.9th percentile of each pixel's largest absolute difference
    double psnr = 0;  ///< dB for a peak of 1; infinite for equal images
    double flip =
        0;  ///< mean LDR-FLIP of the images as a PNG shows them (toneMap(), 67 pixels per degree)
    std::uint64_t nonFinite = 0;  ///< pixels with NaN or infinity in either image, not excluded
    std::uint64_t excluded = 0;   ///< pixels that the mask took out
};

/// The metrics and where in the image they come from.
struct Comparison {
    ErrorMetrics metrics;
    std::vector<float>
        absolute;  ///< per pixel largest absolute difference; 0 excluded, infinite non-finite
    std::vector<float> flip;  ///< per pixel FLIP; 0 excluded or non-finite
};

/// Compares two images; pixels where `exclude` (empty, or one per pixel) is not 0 are left out.
/// Throws an input Error if the sizes differ.
Comparison compareImages(const Image& test, const Image& reference,
                         std::span<const std::uint8_t> exclude = {});

/// 1 where two renderers saw different triangles, from the hashes in their results; to be excluded.
/// Throws an input Error if the sizes differ.
std::vector<std::uint8_t> findDisagreement(std::span<const std::uint32_t> a,
                                           std::span<const std::uint32_t> b);

/// A picture of absolute differences on a logarithmic scale: black <= 1e-6, blue 1e-5, green 1e-3,
/// yellow 1e-2, red 1e-1, white >= 1; magenta where not finite.
Image paintErrors(std::span<const float> absolute, int width, int height);

}  // namespace brume::bench
