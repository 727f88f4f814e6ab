// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <particles/cpu_simulation.hpp>

#include "effects.hpp"

namespace brume::particles {
namespace {

/// One particle after `seconds`.
Particle flyOne(scene::Effect effect, double tickRate, double seconds) {
    effect.tickRate = tickRate;
    CpuSimulation simulation(effect, 1);
    simulation.advanceTo(seconds);
    EXPECT_EQ(simulation.particles().size(), 1u);
    return simulation.particles()[0];
}

constexpr double kTickRates[] = {1, 24, 30, 60, 144, 1000, 10000};

TEST(Motion, FreeFall_IsExactAtAnyTickRate) {
    scene::Effect effect = burstEffect(1, 3, {1, 0, 0});
    effect.modules = {moduleSettings("gravity")};
    for (const double tickRate : kTickRates) {
        const Particle p = flyOne(effect, tickRate, 2);
        // What is left is the rounding of `tickRate` additions.
        EXPECT_NEAR(p.position.y, -0.5 * 9.81 * 4, 2e-3) << tickRate;
        EXPECT_NEAR(p.position.x, 6, 2e-3) << tickRate;
        EXPECT_NEAR(p.velocity.y, -9.81 * 2, 1e-3) << tickRate;
    }
    EXPECT_NEAR(flyOne(effect, 60, 2).position.y, -0.5 * 9.81 * 4, 2e-5);
}

TEST(Motion, DragGravityAndWind_MatchTheClosedForm) {
    const dvec3 wind(4, 1, -2), gravity(0, -9.81, 0), start(1, 2, 3);
    for (const double rate : {1e-6, 0.01, 0.5, 3.0, 40.0}) {
        scene::Effect effect = burstEffect(1, glm::length(start), start);
        effect.modules = {
            moduleSettings("gravity"),
            moduleSettings("drag", {{"rate", {rate}}, {"wind", {wind.x, wind.y, wind.z}}})};
        const double t = 2;
        const double phi1 = -std::expm1(-rate * t) / rate;
        const double phi2 = rate * t > 1e-3 ? (t - phi1) / rate : t * t * (0.5 - rate * t / 6);
        const dvec3 velocity = wind + (start - wind) * std::exp(-rate * t) + gravity * phi1;
        const dvec3 position = wind * t + (start - wind) * phi1 + gravity * phi2;
        for (const double tickRate : kTickRates) {
            const Particle p = flyOne(effect, tickRate, t);
            EXPECT_LT(glm::length(dvec3(p.position) - position), 2e-3) << rate << " " << tickRate;
            EXPECT_LT(glm::length(dvec3(p.velocity) - velocity), 2e-3) << rate << " " << tickRate;
        }
    }
}

TEST(Motion, Falling_ReachesTerminalVelocity) {
    scene::Effect effect = burstEffect(1);
    effect.modules = {moduleSettings("gravity"),
                      moduleSettings("drag", {{"rate", {2}}, {"wind", {1, 0, 0}}})};
    const Particle p = flyOne(effect, 60, 30);
    EXPECT_NEAR(p.velocity.y, -9.81 / 2, 1e-5);
    EXPECT_NEAR(p.velocity.x, 1, 1e-6);
}

TEST(Motion, StiffDrag_StaysFiniteAndFollowsTheWind) {
    scene::Effect effect = burstEffect(1, 1000);
    effect.modules = {moduleSettings("drag", {{"rate", {1e5}}, {"wind", {1, 0, 0}}})};
    for (const double tickRate : {1.0, 100.0, 10000.0}) {
        const Particle p = flyOne(effect, tickRate, 5);
        EXPECT_NEAR(p.velocity.x, 1, 1e-5);
        EXPECT_NEAR(p.velocity.y, 0, 1e-5);
        EXPECT_NEAR(p.position.x, 5, 1e-2);
    }
}

TEST(Motion, BirthWithinATick_MatchesTheClosedForm) {
    // Born at 0.37 of a tick of one second with drag and gravity.
    scene::Effect effect = burstEffect(1, 5);
    effect.emitters[0].bursts = {{0.37, 1}};
    effect.modules = {moduleSettings("gravity"), moduleSettings("drag", {{"rate", {6}}})};
    const double t = 1 - 0.37;
    const double phi1 = -std::expm1(-6 * t) / 6;
    const Particle p = flyOne(effect, 1, 1);
    EXPECT_NEAR(p.velocity.y, 5 * std::exp(-6 * t) - 9.81 * phi1, 1e-5);
    EXPECT_NEAR(p.position.y, 5 * phi1 - 9.81 * (t - phi1) / 6, 1e-5);
}

TEST(Motion, NoiseField_ConvergesWithTheTickRate) {
    scene::Effect effect = burstEffect(1, 1);
    effect.modules = {
        moduleSettings("drag", {{"rate", {1}}}),
        moduleSettings("curl_noise", {{"strength", {3}}, {"scale", {2}}, {"octaves", {2}}})};
    const dvec3 fine = flyOne(effect, 10000, 1).position;
    const double coarse = glm::length(dvec3(flyOne(effect, 20, 1).position) - fine);
    const double middle = glm::length(dvec3(flyOne(effect, 80, 1).position) - fine);
    // Second order: a quarter of the tick, a sixteenth of the error.
    EXPECT_NEAR(coarse / middle, 16, 4);
    EXPECT_LT(middle, 5e-4);
}

TEST(Motion, HugeForces_KillInsteadOfSpreadingInfinities) {
    scene::Effect effect = burstEffect(10, 1e6);
    effect.tickRate = 1;
    effect.modules.assign(16, moduleSettings("gravity", {{"acceleration", {1e12, 1e12, 1e12}}}));
    CpuSimulation simulation(effect, 1);
    simulation.step(1000);
    for (const Particle& p : simulation.particles())
        for (int axis = 0; axis < 3; ++axis) ASSERT_TRUE(std::isfinite(p.position[axis]));
    EXPECT_EQ(simulation.counters().died, 10u);
    EXPECT_EQ(simulation.counters().alive, simulation.counters().born - simulation.counters().died);
}

}  // namespace
}  // namespace brume::particles
