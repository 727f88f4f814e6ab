// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bench/error_metrics.hpp>
#include <bench/flip.hpp>
#include <bench/statistics.hpp>
#include <cmath>
#include <core/error.hpp>
#include <core/image_io.hpp>

#include <shaders/common/heat.h>

namespace brume::bench {
namespace {

bool isFinite(const vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Which pixels count. Non-finite ones are told apart from excluded ones by the counts only.
std::vector<bool> selectPixels(const Image& test, const Image& reference,
                               std::span<const std::uint8_t> exclude, ErrorMetrics& metrics) {
    std::vector<bool> selected(test.pixels.size());
    for (std::size_t i = 0; i < selected.size(); ++i) {
        const bool isExcluded = !exclude.empty() && exclude[i] != 0;
        const bool finite = isFinite(test.pixels[i]) && isFinite(reference.pixels[i]);
        metrics.excluded += isExcluded;
        metrics.nonFinite += !isExcluded && !finite;
        selected[i] = !isExcluded && finite;
    }
    return selected;
}

void measureDifferences(const Image& test, const Image& reference,
                        const std::vector<bool>& selected, Comparison& result) {
    double sum = 0, sumOfSquares = 0;
    std::vector<double> largest;
    for (std::size_t i = 0; i < selected.size(); ++i) {
        if (!selected[i]) continue;
        const dvec3 d = dvec3(test.pixels[i]) - dvec3(reference.pixels[i]);
        sum += d.x + d.y + d.z;
        sumOfSquares += glm::dot(d, d);
        largest.push_back(std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}));
        result.absolute[i] = static_cast<float>(largest.back());
    }
    if (largest.empty()) return;
    const double count = 3.0 * static_cast<double>(largest.size());
    ErrorMetrics& m = result.metrics;
    m.rmse = std::sqrt(sumOfSquares / count);
    m.bias = sum / count;
    m.max = *std::max_element(largest.begin(), largest.end());
    m.p999 = percentile(std::move(largest), 0.999);
}

/// The image as a PNG shows it. Pixels that do not count become black in both images, so that
/// the filters find no difference there.
Image toneMapSelected(const Image& image, const std::vector<bool>& selected) {
    Image mapped(image.width, image.height);
    for (std::size_t i = 0; i < selected.size(); ++i)
        if (selected[i])
            for (int c = 0; c < 3; ++c)
                mapped.pixels[i][c] = std::clamp(toneMap(image.pixels[i][c]), 0.f, 1.f);
    return mapped;
}

void measureFlip(const Image& test, const Image& reference, const std::vector<bool>& selected,
                 Comparison& result) {
    result.flip =
        computeFlip(toneMapSelected(test, selected), toneMapSelected(reference, selected));
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < selected.size(); ++i) {
        if (!selected[i]) result.flip[i] = 0;
        sum += result.flip[i];
        count += selected[i];
    }
    result.metrics.flip = count > 0 ? sum / count : 0;
}

}  // namespace

Comparison compareImages(const Image& test, const Image& reference,
                         std::span<const std::uint8_t> exclude) {
    if (test.width != reference.width || test.height != reference.height)
        throw inputError(
            "comparing images", "",
            fmt::format("one has {}x{} pixels, the other {}x{}, their sizes must be equal",
                        test.width, test.height, reference.width, reference.height));
    if (!exclude.empty() && exclude.size() != test.pixels.size())
        throw inputError("comparing images", "",
                         fmt::format("the mask has {} pixels, the images have {}", exclude.size(),
                                     test.pixels.size()));
    Comparison result;
    const std::vector<bool> selected = selectPixels(test, reference, exclude, result.metrics);
    result.absolute.assign(test.pixels.size(), 0.f);
    measureDifferences(test, reference, selected, result);
    for (std::size_t i = 0; i < selected.size(); ++i)
        if (!selected[i] && (exclude.empty() || exclude[i] == 0))
            result.absolute[i] = std::numeric_limits<float>::infinity();
    result.metrics.psnr = -20 * std::log10(result.metrics.rmse);
    if (!test.isEmpty()) measureFlip(test, reference, selected, result);
    return result;
}

std::vector<std::uint8_t> findDisagreement(std::span<const std::uint32_t> a,
                                           std::span<const std::uint32_t> b) {
    if (a.size() != b.size())
        throw inputError("comparing triangles", "",
                         fmt::format("one image has {} pixels, the other {}", a.size(), b.size()));
    std::vector<std::uint8_t> mask(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) mask[i] = a[i] != b[i];
    return mask;
}

Image paintErrors(std::span<const float> absolute, int width, int height) {
    Image image(width, height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        if (!std::isfinite(absolute[i])) {
            image.pixels[i] = {1, 0, 1};
            continue;
        }
        image.pixels[i] = shader::heatColor(std::log10(std::max(absolute[i], 1e-6f)) + 6);
    }
    return image;
}

}  // namespace brume::bench
