// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <shaders/common/random.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

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

/// A stream of uniform numbers by the index of what is counted.
using Draw = std::function<float(uint)>;

/// Everything that a number may be mistaken for: neighbours in each argument, and the other words.
std::vector<std::pair<std::string, Draw>> neighbours() {
    std::vector<std::pair<std::string, Draw>> draws;
    const auto add = [&](const std::string& name, RandomStream stream, uint shift, uint channel,
                         int word) {
        draws.emplace_back(name, [=](uint i) {
            return unitFloat(randomWords(stream, i + shift, channel)[word]);
        });
    };
    for (int word = 0; word < 4; ++word)
        add("word " + std::to_string(word), {1, 2, 3}, 0, 0, word);
    for (const uint bit : {0u, 1u, 7u, 31u}) {
        add("low seed bit " + std::to_string(bit), {1u ^ (1u << bit), 2, 3}, 0, 0, 0);
        add("high seed bit " + std::to_string(bit), {1, 2u ^ (1u << bit), 3}, 0, 0, 0);
        add("instance bit " + std::to_string(bit), {1, 2, 3u ^ (1u << bit)}, 0, 0, 0);
    }
    for (const uint channel : {1u, 2u, 6u, 18u, 16u * 7 + 2})
        add("channel " + std::to_string(channel), {1, 2, 3}, 0, channel, 0);
    for (const uint shift : {1u, 2u, 64u, 1000000u})
        add("birth + " + std::to_string(shift), {1, 2, 3}, shift, 0, 0);
    // Arguments that change places.
    add("seed and instance", {3, 2, 1}, 0, 0, 0);
    add("halves of the seed", {2, 1, 3}, 0, 0, 0);
    return draws;
}

// Every pair of them, by linear correlation and by a chi-square over 8 x 8 cells, which also sees
// what has no correlation. p = 0.001 in all, divided by the number of tests (Bonferroni).
TEST(RandomWords, AnyTwoNeighbours_AreIndependent) {
    constexpr uint kCount = 20000, kCells = 8;
    const auto draws = neighbours();
    std::vector<std::vector<float>> values(draws.size(), std::vector<float>(kCount));
    for (std::size_t d = 0; d < draws.size(); ++d)
        for (uint i = 0; i < kCount; ++i) values[d][i] = draws[d].second(i);
    // 351 pairs: 1.4e-6 for each of 702 tests. |z| < 4.83; chi-square of 49 degrees < 110.4.
    ASSERT_LE(draws.size() * (draws.size() - 1), 702u);
    for (std::size_t a = 0; a < draws.size(); ++a)
        for (std::size_t b = a + 1; b < draws.size(); ++b) {
            double sum = 0;
            std::array<double, kCells * kCells> cells{};
            std::array<double, kCells> rows{}, columns{};
            for (uint i = 0; i < kCount; ++i) {
                const float x = values[a][i], y = values[b][i];
                sum += (x - 0.5) * (y - 0.5);
                const auto row = static_cast<uint>(x * kCells), column = static_cast<uint>(y * kCells);
                ++cells[row * kCells + column];
                ++rows[row];
                ++columns[column];
            }
            const double z = sum * 12 / std::sqrt(double{kCount});
            double chiSquare = 0;
            for (uint row = 0; row < kCells; ++row)
                for (uint column = 0; column < kCells; ++column) {
                    const double wanted = rows[row] * columns[column] / kCount;
                    const double difference = cells[row * kCells + column] - wanted;
                    chiSquare += difference * difference / wanted;
                }
            EXPECT_LT(std::abs(z), 4.83) << draws[a].first << ", " << draws[b].first;
            EXPECT_LT(chiSquare, 110.4) << draws[a].first << ", " << draws[b].first;
        }
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
