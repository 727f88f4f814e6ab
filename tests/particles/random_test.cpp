// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <shaders/common/random.h>

#include <array>
#include <cmath>

namespace brume::shader {
namespace {

// kat_vectors of the Random123 library, by the authors of Philox.
TEST(Philox, KnownAnswers_Match) {
    EXPECT_EQ(philox4x32(uvec4(0), uvec2(0)),
              uvec4(0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8));
    EXPECT_EQ(philox4x32(uvec4(~0u), uvec2(~0u)),
              uvec4(0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd));
    EXPECT_EQ(philox4x32(uvec4(0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344),
                         uvec2(0xa4093822, 0x299f31d0)),
              uvec4(0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1));
}

TEST(UnitFloat, ExtremeWords_StayBelowOne) {
    EXPECT_EQ(unitFloat(0u), 0.0f);
    EXPECT_LT(unitFloat(~0u), 1.0f);
    EXPECT_EQ(signedUnitFloat(0u), -1.0f);
    EXPECT_LT(signedUnitFloat(~0u), 1.0f);
}

// Correlation of two streams of n uniform numbers; its standard deviation is 1 / sqrt(n).
template <typename Second>
double correlation(Second&& second) {
    constexpr uint kCount = 100000;
    double sum = 0;
    for (uint i = 0; i < kCount; ++i)
        sum += (unitFloat(randomWords({1, 2, 3}, i, 0).x) - 0.5) * (second(i) - 0.5);
    return sum / kCount * 12;
}

TEST(RandomWords, OtherSeedInstanceChannelNeighbourOrWord_IsUncorrelated) {
    constexpr double kBound = 5 / 316.2;  // five standard deviations
    EXPECT_NEAR(correlation([](uint i) {
                    return unitFloat(randomWords({2, 2, 3}, i, 0).x);
                }),
                0, kBound);
    EXPECT_NEAR(correlation([](uint i) {
                    return unitFloat(randomWords({1, 3, 3}, i, 0).x);
                }),
                0, kBound);
    EXPECT_NEAR(correlation([](uint i) {
                    return unitFloat(randomWords({1, 2, 4}, i, 0).x);
                }),
                0, kBound);
    EXPECT_NEAR(correlation([](uint i) {
                    return unitFloat(randomWords({1, 2, 3}, i, 1).x);
                }),
                0, kBound);
    EXPECT_NEAR(correlation([](uint i) {
                    return unitFloat(randomWords({1, 2, 3}, i + 1, 0).x);
                }),
                0, kBound);
    EXPECT_NEAR(correlation([](uint i) {
                    return unitFloat(randomWords({1, 2, 3}, i, 0).y);
                }),
                0, kBound);
    EXPECT_NEAR(correlation([](uint i) {
                    return unitFloat(randomWords({1, 2, 3}, i, 0).x);
                }),
                1, kBound);
}

TEST(RandomWords, Histogram_PassesChiSquare) {
    constexpr uint kCount = 256000;
    std::array<double, 256> bins{};
    for (uint i = 0; i < kCount; ++i) ++bins[randomWords({7, 0, 0}, i, 1).w >> 24u];
    double chiSquare = 0;
    for (const double n : bins) chiSquare += (n - 1000) * (n - 1000) / 1000;
    // 255 degrees of freedom: mean 255, deviation 22.6.
    EXPECT_GT(chiSquare, 255 - 5 * 22.6);
    EXPECT_LT(chiSquare, 255 + 5 * 22.6);
}

}  // namespace
}  // namespace brume::shader
