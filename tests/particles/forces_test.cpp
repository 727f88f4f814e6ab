// SPDX-License-Identifier: Apache-2.0
// Each force against its closed form, and how it converges.
#include <gtest/gtest.h>
#include <shaders/particles/step.h>
#include <particles/cpu_simulation.hpp>

#include "effects.hpp"

namespace brume::particles {
namespace {

/// The particle of a burst at `place` after `seconds`.
Particle fly(scene::Effect effect, const dvec3& place, double tickRate, double seconds) {
    effect.emitters[0].position = place;
    effect.tickRate = tickRate;
    CpuSimulation simulation(effect, 1);
    simulation.advanceTo(seconds);
    EXPECT_EQ(simulation.particles().size(), 1u);
    return simulation.particles().empty() ? Particle{} : simulation.particles()[0];
}

TEST(QuadraticDrag, WithoutOtherForces_MatchesTheClosedForm) {
    // v = v0 / (1 + c v0 t), x = ln(1 + c v0 t) / c.
    scene::Effect effect = burstEffect(1, 20, {1, 0, 0});
    effect.modules = {moduleSettings("quadratic_drag", {{"coefficient", {0.3}}})};
    const double growth = 1 + 0.3 * 20 * 2;
    const Particle p = fly(effect, dvec3(0), 480, 2);
    EXPECT_NEAR(p.velocity.x, 20 / growth, 1e-4);
    EXPECT_NEAR(p.position.x, std::log(growth) / 0.3, 1e-3);
}

TEST(QuadraticDrag, Falling_ConvergesToTheTerminalVelocity) {
    scene::Effect effect = burstEffect(1);
    effect.modules = {moduleSettings("gravity"),
                      moduleSettings("quadratic_drag", {{"coefficient", {0.2}}})};
    const double exact = std::sqrt(9.81 / 0.2);
    const auto error = [&](double tickRate) {
        return std::abs(-double{fly(effect, dvec3(0), tickRate, 20).velocity.y} - exact);
    };
    EXPECT_LT(error(120), 1e-3);
    // Second order.
    EXPECT_NEAR(error(5) / error(10), 4, 0.5);
}

TEST(Attractor, CircularOrbit_ClosesAfterItsPeriod) {
    // v^2 = strength reference^2 / r; strength 9 at 1 m, r = 4 m: v = 1.5 m/s.
    scene::Effect effect = burstEffect(1, 1.5, {0, 0, 1});
    effect.modules = {moduleSettings("attractor", {{"strength", {9}}, {"core", {0}}})};
    const double period = 2 * kPi * 4 / 1.5;
    double last = 0;
    for (const double tickRate : {8.0, 16.0, 32.0}) {
        const double ticks = std::floor(period * tickRate);
        const Particle p = fly(effect, {4, 0, 0}, tickRate, ticks / tickRate);
        const double rest = period - ticks / tickRate;
        // The rest of the period, to third order.
        const dvec3 place = dvec3(p.position) + dvec3(p.velocity) * rest -
                            dvec3(0.5 * 9 / 16 * rest * rest, 0, 0);
        const double error = glm::length(place - dvec3(4, 0, 0));
        EXPECT_LT(error, 1.3 / (tickRate * tickRate));
        if (last > 0) {
            EXPECT_NEAR(last / error, 4, 1.2);
        }
        last = error;
    }
}

TEST(Attractor, HundredOrbits_KeepTheirEnergy) {
    scene::Effect effect = burstEffect(1, 1, {0, 0, 1});  // an ellipse
    effect.modules = {moduleSettings("attractor", {{"strength", {9}}, {"core", {0}}})};
    const Particle p = fly(effect, {4, 0, 0}, 120, 1000);
    const double energy = 0.5 * glm::dot(dvec3(p.velocity), dvec3(p.velocity)) -
                          9 / glm::length(dvec3(p.position));
    EXPECT_NEAR(energy, 0.5 - 9.0 / 4, 5e-3);
}

TEST(Attractor, Spring_HasItsPeriod) {
    scene::Effect effect = burstEffect(1);
    effect.modules = {
        moduleSettings("attractor", {{"strength", {4}}, {"falloff", {-1}}, {"core", {0}}})};
    const Particle p = fly(effect, {1, 0, 0}, 1000, kPi / 2);  // half a period: the other side
    EXPECT_NEAR(p.position.x, -1, 1e-4);
    EXPECT_NEAR(fly(effect, {1, 0, 0}, 1000, kPi).position.x, 1, 1e-4);
}

TEST(Attractor, Line_PullsAcrossItsAxisOnly) {
    scene::Effect effect = burstEffect(1);
    effect.modules = {moduleSettings(
        "attractor", {{"axis", {0, 2, 0}}, {"falloff", {0}}, {"strength", {2}}, {"core", {0}}})};
    const Particle p = fly(effect, {3, 7, 0}, 100, 1);
    EXPECT_NEAR(p.position.y, 7, 1e-6);
    EXPECT_NEAR(p.position.x, 3 - 0.5 * 2, 1e-4);
}

TEST(Attractor, KillRadius_SwallowsWhatFliesThrough) {
    scene::Effect effect = burstEffect(1, 1000, {1, 0, 0});
    effect.emitters[0].position = {-2, 0.01, 0};
    effect.modules = {moduleSettings("attractor", {{"strength", {0}}, {"killRadius", {0.02}}})};
    CpuSimulation simulation(effect, 1);
    simulation.step(3);
    EXPECT_EQ(simulation.counters().died, 1u);
}

TEST(Vortex, Air_HasItsCirculation) {
    scene::Effect effect = burstEffect(1);
    effect.modules = {moduleSettings("vortex", {{"center", {1, 2, 3}}, {"axis", {1, 1, 0.5}},
                                                {"circulation", {5}}, {"core", {0.4}}})};
    const auto parameters = compileEffect(effect)[0].parameters;
    const dvec3 axis = glm::normalize(dvec3(1, 1, 0.5));
    const dvec3 across = glm::normalize(glm::cross(axis, dvec3(1, 0, 0)));
    const dvec3 other = glm::cross(axis, across);
    for (const double radius : {0.1, 0.4, 3.0, 50.0}) {
        double sum = 0;
        constexpr int kSteps = 360;
        for (int i = 0; i < kSteps; ++i) {
            const double angle = 2 * kPi * i / kSteps;
            const dvec3 out = across * std::cos(angle) + other * std::sin(angle);
            const dvec3 along = other * std::cos(angle) - across * std::sin(angle);
            const dvec3 air = shader::vortexVelocity(
                parameters.vortex[0], vec3(dvec3(1, 2, 3) + out * radius + axis * 0.7));
            sum += glm::dot(air, along) * 2 * kPi * radius / kSteps;
        }
        EXPECT_NEAR(sum, 5 * radius * radius / (radius * radius + 0.16), 2e-5) << radius;
    }
}

TEST(Vortex, StiffParticles_CircleWithTheAir) {
    // Midpoint steps: the error of a turn falls with the square of the tick.
    scene::Effect effect = burstEffect(1, 2.5 / 2, {0, 0, -1});
    effect.modules = {moduleSettings(
        "vortex", {{"circulation", {2 * kPi * 2.5}}, {"core", {1e-3}}, {"rate", {1e5}}})};
    const double period = 2 * kPi * 2 / (2.5 / 2);
    const auto radiusAfterATurn = [&](double tickRate) {
        return glm::length(dvec3(fly(effect, {2, 0, 0}, tickRate, period).position));
    };
    EXPECT_NEAR(radiusAfterATurn(200), 2, 2e-3);
    // A drag that is not infinite lets them drift outwards, v^2 / r / rate.
    const double drift = 1.25 * 1.25 / 2 / 1e5 * period;
    EXPECT_GT((radiusAfterATurn(10) - 2 - drift) / (radiusAfterATurn(20) - 2 - drift), 3.5);
}

TEST(CurlNoise, Drift_CarriesTheFieldAlong) {
    scene::Effect effect = burstEffect(1);
    effect.modules = {moduleSettings(
        "curl_noise", {{"drift", {3, -1, 2}}, {"octaves", {3}}, {"scale", {0.7}}})};
    const CompiledEffect compiled = compileEffect(effect)[0];
    const auto at = [&](std::uint64_t tick, const dvec3& place) {
        return dvec3(shader::surroundingsAt(compiled.parameters, nullptr, compiled.parameters.step,
                                            tickFields(compiled, tick), 5, vec3(place))
                         .acceleration);
    };
    for (const std::uint64_t tick : {120u, 1200u, 20736000u}) {  // 1 s, 10 s, 48 h
        const dvec3 moved = dvec3(3, -1, 2) * (static_cast<double>(tick) / 120);
        // 48 h away floats have no digits left for the place, the drift still has: half a tick back.
        const dvec3 here(0.3, 0.4, 0.5);
        if (tick < 10000) {
            EXPECT_LT(glm::length(at(tick, here + moved) - at(0, here)), 2e-3) << tick;
        }
        EXPECT_GT(glm::length(at(tick, here)), 0) << tick;
        const dvec3 step = dvec3(3, -1, 2) / 120.0;
        EXPECT_LT(glm::length(at(tick + 1, here + step) - at(tick, here)), 2e-5) << tick;
    }
}

TEST(Forces, AnyTick_StaysFiniteAndBounded) {
    scene::Effect effect = fullEffect(300);
    for (const double tickRate : {1.0, 5.0, 30.0, 600.0, 10000.0}) {
        effect.subEmitters.clear();
        effect.tickRate = tickRate;
        CpuSimulation simulation(effect, 1);
        simulation.step(200);
        EXPECT_EQ(simulation.counters().killed, 0u) << tickRate;
        for (const Particle& p : simulation.particles())
            ASSERT_LT(glm::length(dvec3(p.position)), 20) << tickRate;  // inside its colliders
        effect = fullEffect(300);
    }
}

}  // namespace
}  // namespace brume::particles
