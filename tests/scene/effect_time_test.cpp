// SPDX-License-Identifier: Apache-2.0
// The own time of an effect in a scene: start, timeScale, loop, prewarm.
#include <gtest/gtest.h>
#include <scene/scene.hpp>

namespace brume::scene {
namespace {

double ownTime(EffectInstance instance, double time) {
    instance.time = time;
    return instance.simulatedSeconds();
}

TEST(EffectTime, Plain_IsThatOfTheFrame) {
    EXPECT_EQ(ownTime({}, 0), 0);
    EXPECT_EQ(ownTime({}, 2.5), 2.5);
}

TEST(EffectTime, BeforeItsStart_NothingHasHappened) {
    EXPECT_EQ(ownTime({.start = 3}, 2.999), 0);
    EXPECT_EQ(ownTime({.start = 3, .prewarm = 5}, 2.999), 0);
    EXPECT_EQ(ownTime({.start = 3}, 3), 0);
    EXPECT_EQ(ownTime({.start = 3}, 4.5), 1.5);
}

TEST(EffectTime, Scale_SlowsHastensAndPauses) {
    EXPECT_EQ(ownTime({.timeScale = 0.25}, 8), 2);
    EXPECT_EQ(ownTime({.start = 1, .timeScale = 4}, 3), 8);
    for (const double time : {0.0, 1.0, 1e6}) EXPECT_EQ(ownTime({.timeScale = 0}, time), 0) << time;
    // Paused with what it has been prewarmed to.
    EXPECT_EQ(ownTime({.timeScale = 0, .prewarm = 2}, 77), 2);
}

TEST(EffectTime, Loop_BeginsAnewInItsOwnSeconds) {
    EXPECT_NEAR(ownTime({.loop = 2}, 1.75), 1.75, 1e-12);
    EXPECT_NEAR(ownTime({.loop = 2}, 2), 0, 1e-12);
    EXPECT_NEAR(ownTime({.loop = 2}, 7.5), 1.5, 1e-12);
    EXPECT_NEAR(ownTime({.start = 1, .timeScale = 2, .loop = 3}, 3), 1, 1e-12);
    EXPECT_NEAR(ownTime({.loop = 2}, 48 * 3600 + 0.5), 0.5, 1e-9);
}

TEST(EffectTime, Prewarm_IsAddedToEveryTurnOfALoop) {
    EXPECT_EQ(ownTime({.prewarm = 4}, 0), 4);
    EXPECT_EQ(ownTime({.prewarm = 4}, 1), 5);
    EXPECT_NEAR(ownTime({.loop = 2, .prewarm = 4}, 3), 5, 1e-12);
}

}  // namespace
}  // namespace brume::scene
