// SPDX-License-Identifier: Apache-2.0
#include <core/math.hpp>

#include <gtest/gtest.h>

#include <random>

namespace brume::test {
namespace {

TEST(Math, FloatAndItsRounding_HoldFortyEightBits) {
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<double> uniform(-10, 10);
    for (int i = 0; i < 1000; ++i) {
        const dvec3 value(uniform(engine), uniform(engine), uniform(engine));
        const dvec3 kept = dvec3(vec3(value)) + dvec3(roundingOf(value));
        for (int axis = 0; axis < 3; ++axis) {
            // One by one, away from what compilers do to vectors.
            volatile float nearest = static_cast<float>(value[axis]);
            EXPECT_EQ(roundingOf(value)[axis], static_cast<float>(value[axis] - nearest));
            EXPECT_NEAR(kept[axis], value[axis], 1e-13);
        }
    }
}

}  // namespace
}  // namespace brume::test
