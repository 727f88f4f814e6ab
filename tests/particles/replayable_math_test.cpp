// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <shaders/common/replayable_math.h>

#include <algorithm>
#include <cmath>

namespace brume::shader {
namespace {

TEST(SqrtReplayable, AllMagnitudes_AreExactToOneUlp) {
    for (double x = 1e-30; x < 1e30; x *= 1.0137) {
        const auto f = static_cast<float>(x);
        const double exact = std::sqrt(static_cast<double>(f));
        ASSERT_NEAR(sqrtReplayable(f) / exact, 1, 1.2e-7) << f;
    }
    EXPECT_EQ(sqrtReplayable(0.0f), 0.0f);
    EXPECT_EQ(sqrtReplayable(1e-38f), 0.0f);
}

TEST(CosSinTurns, WholeCircle_IsExactTo2e7) {
    for (int i = 0; i <= 100000; ++i) {
        const float turns = static_cast<float>(i) / 100000;
        float c = 0, s = 0;
        cosSinTurns(turns, c, s);
        const double angle = 2 * std::acos(-1.0) * static_cast<double>(turns);
        ASSERT_NEAR(c, std::cos(angle), 2e-7) << turns;
        ASSERT_NEAR(s, std::sin(angle), 2e-7) << turns;
    }
}

TEST(ExponentialFactors, AnyHalvings_MatchClosedForm) {
    for (uint halvings = 0; halvings <= 10; ++halvings) {
        const double top = std::exp2(halvings);
        const double bound = 1e-6 * std::max(1.0, top / 32);
        for (int i = 1; i <= 1000; ++i) {
            const auto y = static_cast<float>(top * i / 1000);
            const double exact = y;
            float loss = 0, phi1 = 0, phi2 = 0;
            exponentialFactors(y, halvings, loss, phi1, phi2);
            const double exactPhi1 = -std::expm1(-exact) / exact;
            const double exactPhi2 =
                exact > 1e-2 ? (1 - exactPhi1) / exact : 0.5 - exact / 6 + exact * exact / 24;
            ASSERT_NEAR(loss / -std::expm1(-exact), 1, bound) << y;
            ASSERT_NEAR(phi1 / exactPhi1, 1, bound) << y;
            ASSERT_NEAR(phi2 / exactPhi2, 1, bound) << y;
        }
    }
}

TEST(ExponentialFactors, NoDrag_GivesThoseOfFreeFlight) {
    float loss = 0, phi1 = 0, phi2 = 0;
    exponentialFactors(0, 0, loss, phi1, phi2);
    EXPECT_EQ(loss, 0.0f);
    EXPECT_EQ(phi1, 1.0f);
    EXPECT_EQ(phi2, 0.5f);
}

}  // namespace
}  // namespace brume::shader
