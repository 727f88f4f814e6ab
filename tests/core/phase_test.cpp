// SPDX-License-Identifier: Apache-2.0
#include <core/phase.hpp>

#include <gtest/gtest.h>

#include <functional>

namespace brume {
namespace {

/// Integral over the sphere: Simpson's rule in cosTheta, graded towards 1 and -1.
double integrateOverSphere(const std::function<double(double)>& phase) {
    constexpr int kSteps = 200000;
    double sum = 0;
    for (int i = 0; i <= kSteps; ++i) {
        const double u = 2.0 * i / kSteps - 1;
        const double cosTheta = 0.5 * u * (3 - u * u), slope = 1.5 * (1 - u * u);
        const double weight = i == 0 || i == kSteps ? 1 : i % 2 ? 4 : 2;
        sum += weight * phase(cosTheta) * slope;
    }
    return 2 * std::numbers::pi * sum * 2.0 / (3 * kSteps);
}

TEST(Phase_Isotropic, OverTheSphere_IntegratesToOne) {
    EXPECT_NEAR(integrateOverSphere([](double) { return phaseIsotropic<double>(); }), 1, 1e-12);
}

TEST(Phase_Rayleigh, OverTheSphere_IntegratesToOne) {
    EXPECT_NEAR(integrateOverSphere(phaseRayleigh<double>), 1, 1e-12);
}

TEST(Phase_HenyeyGreenstein, OverTheSphere_IntegratesToOneForEachG) {
    for (const double g : {-0.999, -0.5, 0.0, 0.3, 0.9, 0.999})
        EXPECT_NEAR(integrateOverSphere(
                        [g](double cosTheta) { return phaseHenyeyGreenstein(cosTheta, g); }),
                    1, 1e-8)
            << "g = " << g;
}

TEST(Phase_HenyeyGreenstein, GZero_IsIsotropic) {
    EXPECT_DOUBLE_EQ(phaseHenyeyGreenstein(0.3, 0.0), phaseIsotropic<double>());
    EXPECT_GT(phaseHenyeyGreenstein(1.0, 0.5), phaseHenyeyGreenstein(-1.0, 0.5));
}

}  // namespace
}  // namespace brume
