// SPDX-License-Identifier: Apache-2.0
// Every figure of a comparison against its closed form.
#include <gtest/gtest.h>

#include <bench/error_metrics.hpp>
#include <cmath>
#include <core/error.hpp>
#include <limits>

namespace brume::bench {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

TEST(ErrorMetrics, EqualImages_AreAllZeroWithInfinitePsnr) {
    const Image image(17, 5, vec3(0.3f, 2.f, 0.f));
    const ErrorMetrics m = compareImages(image, image).metrics;
    EXPECT_EQ(m.rmse, 0);
    EXPECT_EQ(m.max, 0);
    EXPECT_EQ(m.bias, 0);
    EXPECT_EQ(m.p999, 0);
    EXPECT_EQ(m.flip, 0);
    EXPECT_EQ(m.psnr, kInfinity);
    EXPECT_EQ(m.nonFinite, 0u);
    EXPECT_EQ(m.excluded, 0u);
}

TEST(ErrorMetrics, ConstantOffset_GivesTheOffsetEverywhere) {
    const Image reference(8, 8, vec3(0.5f)), test(8, 8, vec3(0.25f));
    const ErrorMetrics m = compareImages(test, reference).metrics;
    EXPECT_DOUBLE_EQ(m.rmse, 0.25);
    EXPECT_DOUBLE_EQ(m.max, 0.25);
    EXPECT_DOUBLE_EQ(m.bias, -0.25);
    EXPECT_DOUBLE_EQ(m.p999, 0.25);
    EXPECT_NEAR(m.psnr, 20 * std::log10(4), 1e-12);
}

TEST(ErrorMetrics, OppositeErrors_CancelInBiasOnly) {
    const Image reference(2, 1);
    Image test(2, 1);
    test.at(0, 0) = vec3(0.5f);
    test.at(1, 0) = vec3(-0.5f);
    const ErrorMetrics m = compareImages(test, reference).metrics;
    EXPECT_EQ(m.bias, 0);
    EXPECT_DOUBLE_EQ(m.rmse, 0.5);
}

TEST(ErrorMetrics, OneChannelOfOnePixel_IsAveragedOverAllChannels) {
    const Image reference(10, 10);
    Image test(10, 10);
    test.at(3, 7).y = 3;
    const Comparison c = compareImages(test, reference);
    EXPECT_DOUBLE_EQ(c.metrics.rmse, std::sqrt(9.0 / 300));
    EXPECT_DOUBLE_EQ(c.metrics.bias, 0.01);
    EXPECT_DOUBLE_EQ(c.metrics.max, 3);
    EXPECT_EQ(c.absolute[73], 3);
    EXPECT_EQ(c.absolute[72], 0);
}

TEST(ErrorMetrics, FewOutliers_LieAboveTheP999) {
    const Image reference(100, 100);
    Image test(100, 100, vec3(0.001f));
    for (int i = 0; i < 9; ++i) test.at(i, i) = vec3(1);  // 0.09 %
    EXPECT_NEAR(compareImages(test, reference).metrics.p999, 0.001, 1e-8);
    for (int i = 9; i < 12; ++i) test.at(i, i) = vec3(1);  // 0.12 %
    EXPECT_EQ(compareImages(test, reference).metrics.p999, 1);
}

TEST(ErrorMetrics, NonFinitePixels_AreCountedAndLeftOut) {
    Image reference(4, 1, vec3(1)), test(4, 1, vec3(1));
    test.at(0, 0).x = kNaN;
    test.at(1, 0).z = -kInf;
    reference.at(2, 0).y = kInf;
    test.at(3, 0) = vec3(1.5f);
    const Comparison c = compareImages(test, reference);
    EXPECT_EQ(c.metrics.nonFinite, 3u);
    EXPECT_DOUBLE_EQ(c.metrics.rmse, 0.5);
    EXPECT_TRUE(std::isfinite(c.metrics.flip));
    EXPECT_EQ(c.absolute[0], kInf);
}

TEST(ErrorMetrics, ExcludedPixels_AreCountedAndLeftOut) {
    const Image reference(30, 30);
    Image test(30, 30);
    test.at(4, 0) = vec3(1);
    test.at(5, 0) = vec3(kNaN);
    std::vector<std::uint8_t> exclude(900);
    exclude[4] = exclude[5] = 1;
    const ErrorMetrics m = compareImages(test, reference, exclude).metrics;
    EXPECT_EQ(m.excluded, 2u);
    EXPECT_EQ(m.nonFinite, 0u);
    EXPECT_EQ(m.max, 0);
    EXPECT_EQ(m.flip, 0);
}

TEST(ErrorMetrics, NothingLeft_IsAllZero) {
    const Image image(1, 1, vec3(kNaN));
    const ErrorMetrics m = compareImages(image, image).metrics;
    EXPECT_EQ(m.nonFinite, 1u);
    EXPECT_EQ(m.rmse, 0);
    EXPECT_EQ(m.flip, 0);
}

TEST(ErrorMetrics, DifferentSizes_AreRefused) {
    EXPECT_THROW(compareImages(Image(2, 3), Image(3, 2)), Error);
    EXPECT_THROW(compareImages(Image(2, 2), Image(2, 2), std::vector<std::uint8_t>(3)), Error);
}

TEST(FindDisagreement, DifferentHashes_AreMarked) {
    const std::vector<std::uint32_t> a = {1, 2, 3}, b = {1, 5, 3};
    EXPECT_EQ(findDisagreement(a, b), (std::vector<std::uint8_t>{0, 1, 0}));
    EXPECT_THROW(findDisagreement(a, std::vector<std::uint32_t>(2)), Error);
}

TEST(PaintErrors, Ends_AreBlackWhiteAndMagenta) {
    const std::vector<float> errors = {0, 1e-6f, 1, 50, kInf};
    const Image image = paintErrors(errors, 5, 1);
    EXPECT_EQ(image.at(0, 0), vec3(0));
    EXPECT_EQ(image.at(1, 0), vec3(0));
    EXPECT_EQ(image.at(2, 0), vec3(1));
    EXPECT_EQ(image.at(3, 0), vec3(1));
    EXPECT_EQ(image.at(4, 0), vec3(1, 0, 1));
}

}  // namespace
}  // namespace brume::bench
