// SPDX-License-Identifier: Apache-2.0
#include <shadows/blue_noise.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace brume::shadows {
namespace {

TEST(BlueNoise, Tile_HoldsEachRankOnce) {
    std::vector<float> values = makeBlueNoise(32);
    std::sort(values.begin(), values.end());
    for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_NEAR(values[i], (static_cast<double>(i) + 0.5) / 1024, 1e-6);
}

TEST(BlueNoise, Spectrum_IsEmptyAtLowFrequencies) {
    constexpr int kSize = 32;
    const std::vector<float> values = makeBlueNoise(kSize);
    const auto power = [&](int u, int v) {
        std::complex<double> sum = 0;
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x)
                sum += (values[y * kSize + x] - 0.5) *
                       std::polar(1.0, 2 * std::numbers::pi * (u * x + v * y) / kSize);
        return std::norm(sum) / (kSize * kSize);
    };
    double low = 0;
    for (const auto& [u, v] : {std::pair{1, 0}, {0, 1}, {1, 1}, {2, 0}, {0, 2}, {2, 1}, {1, 2}})
        low += power(u, v) / 7;
    EXPECT_LT(low, 0.02 / 12);  // white noise has 1/12 everywhere
}

}  // namespace
}  // namespace brume::shadows
