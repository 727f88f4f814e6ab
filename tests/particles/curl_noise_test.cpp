// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <shaders/particles/step.h>
#include <particles/compiled_effect.hpp>

#include "effects.hpp"

#include <random>

namespace brume::particles {
namespace {

shader::EffectParameters noiseParameters(double octaves, double scale, double strength = 1) {
    scene::Effect effect = burstEffect(1);
    effect.modules = {moduleSettings(
        "curl_noise", {{"strength", {strength}}, {"scale", {scale}}, {"octaves", {octaves}}})};
    return compileEffect(effect)[0].parameters;
}

dvec3 fieldAt(const shader::EffectParameters& parameters, const dvec3& p) {
    return shader::surroundingsAt(parameters, nullptr, parameters.step, shader::TickFields{}, 12,
                                  vec3(p))
        .acceleration;
}

TEST(CurlNoise, Divergence_IsBelowAThousandthOfTheGradient) {
    std::mt19937 generator(4);
    std::uniform_real_distribution<double> coordinate(-20, 20);
    for (const double octaves : {1.0, 3.0}) {
        const auto parameters = noiseParameters(octaves, 1);
        double divergence2 = 0, gradient2 = 0;
        for (int i = 0; i < 20000; ++i) {
            // Steps that floats hold exactly, so that only the field's rounding remains.
            const dvec3 p = glm::round(dvec3(coordinate(generator), coordinate(generator),
                                             coordinate(generator)) *
                                       1024.0) /
                            1024.0;
            const double h = 1.0 / 128;
            double divergence = 0;
            for (int axis = 0; axis < 3; ++axis) {
                dvec3 d(0);
                d[axis] = h;
                // Fourth-order central differences.
                const dvec3 slope =
                    (8.0 * (fieldAt(parameters, p + d) - fieldAt(parameters, p - d)) -
                     (fieldAt(parameters, p + 2.0 * d) - fieldAt(parameters, p - 2.0 * d))) /
                    (12 * h);
                divergence += slope[axis];
                gradient2 += glm::dot(slope, slope);
            }
            divergence2 += divergence * divergence;
        }
        EXPECT_LT(std::sqrt(divergence2 / gradient2), 1e-3) << octaves;
    }
}

TEST(CurlNoise, Strength_IsRootMeanSquare) {
    std::mt19937 generator(5);
    std::uniform_real_distribution<double> coordinate(-100, 100);
    for (const double octaves : {1.0, 2.0, 4.0}) {
        const auto parameters = noiseParameters(octaves, 0.5, 3);
        dvec3 mean(0);
        double square = 0;
        constexpr int kCount = 200000;
        for (int i = 0; i < kCount; ++i) {
            const dvec3 a = fieldAt(
                parameters, {coordinate(generator), coordinate(generator), coordinate(generator)});
            mean += a / double{kCount};
            square += glm::dot(a, a) / kCount;
        }
        EXPECT_NEAR(std::sqrt(square), 3, 0.03) << octaves;
        EXPECT_LT(glm::length(mean), 0.05) << octaves;
    }
}

TEST(CurlNoise, Field_IsContinuous) {
    const auto parameters = noiseParameters(1, 1);
    double largest = 0;
    dvec3 last = fieldAt(parameters, {-3, 0.7, 0.2});
    for (int i = 1; i <= 60000; ++i) {
        const dvec3 a = fieldAt(parameters, {-3 + i * 1e-4, 0.7 + i * 3e-5, 0.2});
        largest = std::max(largest, glm::length(a - last));
        last = a;
    }
    EXPECT_LT(largest, 0.003);
}

TEST(CurlNoise, FarAway_StaysFinite) {
    const auto parameters = noiseParameters(8, 1e-3);
    for (const double x : {1e3, 1e6, 1e9, 1e15, -1e15}) {
        const dvec3 a = fieldAt(parameters, dvec3(x, -x, 2 * x));
        EXPECT_TRUE(std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z)) << x;
        EXPECT_LT(glm::length(a), 100) << x;
    }
}

}  // namespace
}  // namespace brume::particles
