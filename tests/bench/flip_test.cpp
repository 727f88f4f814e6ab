// SPDX-License-Identifier: Apache-2.0
// FLIP against what its paper implies in closed form, and against its filters applied without
// separating them.
#include <gtest/gtest.h>

#include <algorithm>
#include <bench/flip.hpp>
#include <cmath>
#include <functional>
#include <random>

namespace brume::bench {
namespace {

double mean(const std::vector<float>& map) {
    double sum = 0;
    for (float v : map) sum += v;
    return sum / static_cast<double>(map.size());
}

Image makeNoise(int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    Image image(width, height);
    for (vec3& pixel : image.pixels)
        for (int c = 0; c < 3; ++c) pixel[c] = static_cast<float>(random() & 0xffff) / 65535.f;
    return image;
}

// CIELAB with white D65 by the textbook, independent of the code under test.
struct Lab {
    double l, a, b;
};
Lab labOf(double r, double g, double b) {
    const double x = (0.4123908 * r + 0.3575843 * g + 0.1804808 * b) / 0.9504559;
    const double y = 0.2126390 * r + 0.7151687 * g + 0.0721923 * b;
    const double z = (0.0193308 * r + 0.1191948 * g + 0.9505322 * b) / 1.0890578;
    const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116; };
    return {116 * f(y) - 16, 500 * (f(x) - f(y)), 200 * (f(y) - f(z))};
}

// A pair of constant images has no features and nothing to filter: only the colour metric is left.
double flipOfConstants(const Lab& p, const Lab& q) {
    const auto distance = [](const Lab& u, const Lab& v) {
        const double hu = 0.01 * u.l, hv = 0.01 * v.l;
        return std::pow(std::abs(u.l - v.l) + std::hypot(hu * u.a - hv * v.a, hu * u.b - hv * v.b),
                        0.7);
    };
    const double largest = distance(labOf(0, 1, 0), labOf(0, 0, 1));
    const double d = distance(p, q) / largest;
    return d < 0.4 ? 0.95 * d / 0.4 : 0.95 + 0.05 * (d - 0.4) / 0.6;
}

TEST(Flip, EqualImages_AreZero) {
    const Image image = makeNoise(40, 30, 1);
    for (float v : computeFlip(image, image)) EXPECT_EQ(v, 0);
}

TEST(Flip, GreenAndBlue_AreTheLargestDifference) {
    const Image green(32, 32, vec3(0, 1, 0)), blue(32, 32, vec3(0, 0, 1));
    for (float v : computeFlip(green, blue)) EXPECT_NEAR(v, 1, 1e-3);
}

TEST(Flip, ConstantImages_FollowTheColourMetricAlone) {
    const vec3 colors[] = {
        {0, 0, 0}, {1, 1, 1}, {0.5f, 0.5f, 0.5f}, {0.52f, 0.5f, 0.5f}, {0.8f, 0.1f, 0.3f}};
    for (const vec3& p : colors)
        for (const vec3& q : colors) {
            const double expected = flipOfConstants(labOf(p.r, p.g, p.b), labOf(q.r, q.g, q.b));
            for (float v : computeFlip(Image(24, 24, p), Image(24, 24, q)))
                ASSERT_NEAR(v, expected, 2e-3) << p.r << " " << p.g << " against " << q.r;
        }
}

TEST(Flip, SwappedImages_GiveTheSameMap) {
    const Image a = makeNoise(33, 21, 2), b = makeNoise(33, 21, 3);
    const auto ab = computeFlip(a, b), ba = computeFlip(b, a);
    for (std::size_t i = 0; i < ab.size(); ++i) EXPECT_NEAR(ab[i], ba[i], 1e-6);
}

TEST(Flip, MirroredImages_GiveTheMirroredMap) {
    const Image a = makeNoise(20, 20, 4), b = makeNoise(20, 20, 5);
    Image aTurned = a, bTurned = b;
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 20; ++x) aTurned.at(y, x) = a.at(x, y), bTurned.at(y, x) = b.at(x, y);
    const auto map = computeFlip(a, b), turned = computeFlip(aTurned, bTurned);
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 20; ++x) EXPECT_NEAR(map[y * 20 + x], turned[x * 20 + y], 1e-5);
}

TEST(Flip, GrowingNoise_GrowsWithinTheUnitRange) {
    const Image reference(64, 64, vec3(0.5f)), noise = makeNoise(64, 64, 6);
    double previous = 0;
    for (float strength : {0.01f, 0.05f, 0.2f, 0.8f}) {
        Image test = reference;
        for (std::size_t i = 0; i < test.pixels.size(); ++i)
            test.pixels[i] += strength * (noise.pixels[i] - vec3(0.5f));
        const auto map = computeFlip(test, reference);
        EXPECT_GE(*std::min_element(map.begin(), map.end()), 0);
        EXPECT_LE(*std::max_element(map.begin(), map.end()), 1);
        EXPECT_GT(mean(map), previous);
        previous = mean(map);
    }
}

TEST(Flip, OnePixelStripes_FadeWithDistance) {
    Image stripes(128, 32), grey(128, 32, vec3(0.5f));
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 128; ++x) stripes.at(x, y) = vec3(x % 2 == 0 ? 0.6f : 0.4f);
    // The eye resolves fine stripes at 20 pixels per degree and hardly at 200.
    EXPECT_GT(mean(computeFlip(stripes, grey, 20)), 2 * mean(computeFlip(stripes, grey, 200)));
}

// The filters of the paper's section 4 written as full 2-D kernels.
using Filter = std::function<double(double x, double y)>;

std::vector<double> convolve(const std::vector<double>& in, int width, int height, int radius,
                             const Filter& weight) {
    std::vector<double> out(in.size());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int j = -radius; j <= radius; ++j)
                for (int i = -radius; i <= radius; ++i) {
                    const int column = std::clamp(x + i, 0, width - 1);
                    const int row = std::clamp(y + j, 0, height - 1);
                    out[y * width + x] += weight(i, j) * in[row * width + column];
                }
    return out;
}

// Feature strength |grad| of a grey image with weights of each sign normalised to 1.
std::vector<double> strengthOf(const std::vector<double>& grey, int size, double ppd, bool points) {
    const double sigma = 0.5 * 0.082 * ppd;
    const int radius = static_cast<int>(std::ceil(3 * sigma));
    const auto raw = [&](double x, double y) {
        const double g = std::exp(-(x * x + y * y) / (2 * sigma * sigma));
        return points ? (x * x / (sigma * sigma) - 1) * g : -x * g;
    };
    double positive = 0, negative = 0;
    for (int j = -radius; j <= radius; ++j)
        for (int i = -radius; i <= radius; ++i)
            (raw(i, j) > 0 ? positive : negative) += std::abs(raw(i, j));
    const auto normalised = [&](double x, double y) {
        return raw(x, y) / (raw(x, y) > 0 ? positive : negative);
    };
    const auto dx = convolve(grey, size, size, radius, normalised);
    const auto dy =
        convolve(grey, size, size, radius, [&](double x, double y) { return normalised(y, x); });
    std::vector<double> strength;
    for (std::size_t i = 0; i < dx.size(); ++i) strength.push_back(std::hypot(dx[i], dy[i]));
    return strength;
}

// Blur of the achromatic channel (on lightness 116 Y - 16, so on Y), weights summing to 1.
std::vector<double> blurOf(const std::vector<double>& grey, int size, double ppd) {
    const double b = 0.0047;
    const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * ppd));
    const auto raw = [&](double x, double y) {
        return std::exp(-kPi * kPi * (x * x + y * y) / (ppd * ppd) / b);
    };
    double sum = 0;
    for (int j = -radius; j <= radius; ++j)
        for (int i = -radius; i <= radius; ++i) sum += raw(i, j);
    return convolve(grey, size, size, radius, [&](double x, double y) { return raw(x, y) / sum; });
}

TEST(Flip, GreyImages_EqualTheUnseparatedFilters) {
    constexpr int kSize = 28;
    const double ppd = kDefaultPixelsPerDegree;
    Image a(kSize, kSize), b(kSize, kSize);
    std::vector<double> greyA, greyB;
    for (int i = 0; i < kSize * kSize; ++i) {
        const double x = i % kSize, y = i / kSize;
        greyA.push_back(0.5 + 0.4 * std::sin(0.7 * x) * std::cos(0.3 * y));
        greyB.push_back(x + y > 25 ? 0.8 : 0.3);
        a.pixels[i] = vec3(static_cast<float>(greyA[i]));
        b.pixels[i] = vec3(static_cast<float>(greyB[i]));
    }
    const auto blurA = blurOf(greyA, kSize, ppd), blurB = blurOf(greyB, kSize, ppd);
    const auto edgesA = strengthOf(greyA, kSize, ppd, false),
               edgesB = strengthOf(greyB, kSize, ppd, false);
    const auto pointsA = strengthOf(greyA, kSize, ppd, true),
               pointsB = strengthOf(greyB, kSize, ppd, true);
    const auto map = computeFlip(a, b);
    for (int i = 0; i < kSize * kSize; ++i) {
        const double color = flipOfConstants(labOf(blurA[i], blurA[i], blurA[i]),
                                             labOf(blurB[i], blurB[i], blurB[i]));
        const double feature =
            std::sqrt(std::max(std::abs(edgesA[i] - edgesB[i]), std::abs(pointsA[i] - pointsB[i])) /
                      std::sqrt(2));
        ASSERT_NEAR(map[i], std::pow(color, 1 - feature), 2e-3) << "pixel " << i;
    }
}

}  // namespace
}  // namespace brume::bench
