// SPDX-License-Identifier: Apache-2.0
// Sub-emitters: where and when children are born, in which order, and how many.
#include <gtest/gtest.h>
#include <core/error.hpp>
#include <particles/cpu_simulation.hpp>

#include "effects.hpp"

namespace brume::particles {
namespace {

using Trigger = scene::SubEmitterTrigger;

std::shared_ptr<const scene::Effect> childEffect(std::uint32_t capacity = 1000) {
    scene::Effect child;
    child.capacity = capacity;
    child.emitters = {{.bursts = {}, .lifetime = dvec2(1e6)}};
    return std::make_shared<const scene::Effect>(child);
}

TEST(Children, OfADeath_AreBornAtItsPlaceAndTime) {
    scene::Effect effect = burstEffect(1, 2, {1, 0, 0});
    effect.emitters[0].lifetime = dvec2(0.733);
    scene::Effect child = *childEffect();
    child.emitters[0].inherit = 1;
    effect.subEmitters = {{.trigger = Trigger::Death, .count = dvec2(5),
                           .effect = std::make_shared<const scene::Effect>(child)}};
    CpuSimulation simulation(effect, 1);
    simulation.advanceTo(0.73);
    EXPECT_EQ(simulation.counters(1).born, 0u);
    simulation.advanceTo(2);
    ASSERT_EQ(simulation.counters(1).born, 5u);
    // They fly on as the parent did.
    for (const Particle& p : simulation.particles(1)) EXPECT_NEAR(p.position.x, 4, 1e-5);
}

TEST(Children, OfACollision_AreBornOnTheSurface) {
    scene::Effect effect = burstEffect(100, 10, {0, -1, 0});
    effect.emitters[0].position = {0, 1.23, 0};
    effect.modules = {moduleSettings("collide_plane", {{"restitution", {1}}})};
    effect.subEmitters = {{.trigger = Trigger::Collision, .count = dvec2(2),
                           .effect = childEffect()}};
    CpuSimulation simulation(effect, 1);
    simulation.advanceTo(0.5);
    ASSERT_EQ(simulation.counters(1).born, 200u);
    for (const Particle& p : simulation.particles(1)) {
        EXPECT_EQ(p.position, vec3(0));
        // Hit at 0.123 s.
        EXPECT_NEAR((p.life.birthTick + 1 - double{p.life.birthRemaining}) / 120.0, 0.123, 1e-5);
    }
}

TEST(Children, OfAWay_LieOnItAtEvenTimes) {
    scene::Effect effect = burstEffect(3, 3, {1, 0, 0});
    effect.emitters[0].bursts = {{0.0517, 1}};
    effect.emitters[0].lifetime = dvec2(1.234);
    effect.subEmitters = {{.trigger = Trigger::Way, .rate = 77, .effect = childEffect()}};
    CpuSimulation simulation(effect, 1);
    simulation.advanceTo(3);
    ASSERT_EQ(simulation.counters(1).born, static_cast<std::uint32_t>(1.234 * 77));
    for (const Particle& p : simulation.particles(1))
        EXPECT_NEAR(p.position.x, 3 * (p.birthIndex + 1) / 77.0, 3e-5) << p.birthIndex;
}

TEST(Children, FractionsOfACount_AreProbabilities) {
    scene::Effect effect = burstEffect(20000);
    effect.subEmitters = {{.trigger = Trigger::Birth, .count = {0.2, 1.2},
                           .effect = childEffect(50000)}};
    CpuSimulation simulation(effect, 1);
    simulation.step(1);
    // Mean 0.7; its standard deviation is below 0.6 / sqrt(20000).
    EXPECT_NEAR(simulation.counters(1).born / 20000.0, 0.7, 5 * 0.6 / std::sqrt(20000.0));
}

TEST(Children, BeyondTheCapacity_AreCountedAndTheFirstKept) {
    scene::Effect effect = burstEffect(100);
    effect.emitters[0].shape = scene::EmitterShape::Line;
    effect.emitters[0].size = {1, 0, 0};
    effect.subEmitters = {{.trigger = Trigger::Birth, .count = dvec2(3),
                           .effect = childEffect(50)}};
    CpuSimulation simulation(effect, 1);
    simulation.step(2);
    EXPECT_EQ(simulation.counters(1).born, 50u);
    EXPECT_EQ(simulation.counters(1).rejected, 250u);
    // Three to a parent, in the order of the parents.
    for (std::uint32_t i = 0; i < 50; ++i) {
        EXPECT_EQ(simulation.particles(1)[i].birthIndex, i);
        EXPECT_EQ(simulation.particles(1)[i].position, simulation.particles(0)[i / 3].position);
    }
}

TEST(Children, PopulationsOfOneSeed_AreIndependent) {
    const auto parent = instanceParameters(5, 2, 0), child = instanceParameters(5, 2, 1);
    EXPECT_NE(parent.random.seedLow, child.random.seedLow);
    EXPECT_NE(parent.noiseSeed, child.noiseSeed);
    EXPECT_EQ(child.random.instance, 2u);
}

TEST(Children, ImpossibleEffects_AreRefused) {
    const auto message = [](const scene::Effect& effect) {
        try {
            compileEffect(effect);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    scene::Effect effect = burstEffect(1);
    scene::Effect child = *childEffect();
    const auto set = [&] {
        effect.subEmitters = {{.effect = std::make_shared<const scene::Effect>(child),
                               .where = "e.json:7:3"}};
    };
    child.tickRate = 60;
    set();
    EXPECT_NE(message(effect).find("e.json:7:3: the sub-emitter's effect has 'tickRate' 60"),
              std::string::npos)
        << message(effect);
    child.tickRate = 120;
    child.emitters[0].rate = 1;
    set();
    EXPECT_NE(message(effect).find("none allowed in the effect of a sub-emitter"),
              std::string::npos);
    child.emitters.clear();
    set();
    EXPECT_NE(message(effect).find("has 0 emitters, 1 allowed"), std::string::npos);
}

}  // namespace
}  // namespace brume::particles
