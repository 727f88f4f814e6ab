// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <shaders/particles/spawn.h>
#include <shaders/particles/step.h>
#include <particles/cpu_simulation.hpp>

#include "effects.hpp"

namespace brume::particles {
namespace {

/// All forces and colliders, births by rate alone, nothing below it.
scene::Effect lastingEffect() {
    scene::Effect effect = fullEffect(5000);
    effect.subEmitters.clear();
    effect.emitters.resize(1);
    effect.emitters[0].lifetime = {0.1, 0.8};
    return effect;
}

TEST(Jump, PastTicksThatNobodyHasSeen_GivesTheSameBits) {
    const scene::Effect effect = lastingEffect();
    CpuSimulation stepped(effect, 9), jumped(effect, 9);
    const std::uint64_t ticks = 700;
    ASSERT_GT(jumpTick(jumped.effect(), ticks), 0u);
    stepped.step(ticks);
    jumped.advanceTo(static_cast<double>(ticks) / effect.tickRate);
    EXPECT_GT(stepped.particles().size(), 50u);
    EXPECT_EQ(jumped.hash(), stepped.hash());
    EXPECT_EQ(jumped.counters().born, stepped.counters().born);
    EXPECT_EQ(jumped.counters().died, stepped.counters().died);
}

TEST(Jump, EffectsWithMemory_RunThroughAllTicks) {
    scene::Effect full = lastingEffect();
    full.capacity = 100;  // some are turned away
    EXPECT_EQ(jumpTick(compileEffect(full)[0], 700), 0u);
    scene::Effect parents = fullEffect();
    EXPECT_EQ(jumpTick(compileEffect(parents)[0], 700), 0u);
    EXPECT_EQ(jumpTick(compileEffect(burstEffect(3))[0], 700), 0u);  // lives for ever
}

TEST(Jump, To48Hours_RunsOneLifetimeOfTicks) {
    const CompiledEffect effect = compileEffect(lastingEffect())[0];
    const std::uint64_t window = effect.aliveBound.windowTicks();
    EXPECT_LE(window, 0.8 * effect.tickRate + 2);
    for (const double hours : {0.01, 1.0, 48.0}) {
        const std::uint64_t tick = ticksAt(hours * 3600, effect.tickRate);
        EXPECT_EQ(tick - jumpTick(effect, tick), window) << hours;
    }
    // Who is nearer than that goes on from where it is.
    EXPECT_EQ(jumpTick(effect, 5000, 5000 - window), 0u);
    EXPECT_EQ(jumpTick(effect, 5000, 5000 - window - 1), 5000 - window);
}

TEST(Time, PicturesBetweenTicks_MoveEvenly) {
    scene::Effect effect = burstEffect(1, 3, {1, 0, 0});
    effect.tickRate = 10;
    effect.radius = {{{0, 0.05}}};
    CpuSimulation simulation(effect, 1);
    for (int i = 1; i <= 70; ++i) {
        const double seconds = 0.1 + i / 70.0;
        simulation.advanceTo(seconds);
        const auto spheres = simulation.spheres(dmat4(1), 0, 0);
        ASSERT_EQ(spheres.size(), 1u);
        ASSERT_NEAR(spheres[0].center.x, 3 * seconds, 1e-5) << seconds;
    }
    // What dies between two ticks is not shown after that.
    effect.emitters[0].lifetime = dvec2(0.25);
    CpuSimulation mortal(effect, 1);
    mortal.advanceTo(0.24);
    EXPECT_EQ(mortal.spheres(dmat4(1), 0, 0).size(), 1u);
    mortal.advanceTo(0.26);
    EXPECT_EQ(mortal.spheres(dmat4(1), 0, 0).size(), 0u);
}

/// Seconds to ticks as frames of that rate ask for them.
TEST(Time, AnyFrameRate_GivesTheSameBitsAtTheSameTime) {
    const scene::Effect effect = fullEffect(500);
    CpuSimulation whole(effect, 5);
    whole.advanceTo(1);
    for (const int rate : {24, 30, 60, 144}) {
        CpuSimulation framed(effect, 5);
        for (int frame = 1; frame <= rate; ++frame)
            framed.advanceTo(static_cast<double>(frame) / rate);
        EXPECT_EQ(framed.hash(), whole.hash()) << rate << " Hz";
    }
    CpuSimulation random(effect, 5);
    std::uint32_t word = 1;
    for (double time = 0; time < 1; time += 0.03 * shader::unitFloat(word)) {
        random.advanceTo(time);
        word = word * 1664525u + 1013904223u;
    }
    random.advanceTo(1);
    EXPECT_EQ(random.hash(), whole.hash());
}

TEST(Time, FortyEightHoursAndAThousandKilometres_GiveTheSameMotion) {
    scene::Effect effect = burstEffect(1, 0);
    effect.capacity = 4000;
    effect.emitters = {{.rate = 240, .speed = {1, 3}, .spread = 0.5, .lifetime = {1, 2}}};
    effect.modules = {moduleSettings("gravity"), moduleSettings("drag", {{"rate", {0.5}}})};
    effect.radius = {{{0, 0.05}}};
    constexpr double kHours = 48 * 3600.0;
    CpuSimulation later(effect, 1);
    later.advanceTo(kHours + 1);
    EXPECT_EQ(later.tick(), static_cast<std::uint64_t>((kHours + 1) * 120));
    const CompiledEffect& compiled = later.effect();
    ASSERT_FALSE(later.particles().empty());
    for (const Particle& p : later.particles()) {
        // What a particle of these numbers does when it is born at the beginning of time.
        Particle q = shader::spawnParticle(
            compiled.parameters, nullptr, nullptr, instanceParameters(1, 0, 0).random,
            compiled.emitters[0], p.birthIndex, p.life.birthRemaining, 0, vec3(0), vec3(0));
        const shader::TickFields fields{};
        shader::stepParticlePart(compiled.parameters, nullptr, compiled.parameters.step, fields, 0,
                                 p.life.birthRemaining, q);
        for (std::uint64_t tick = p.life.birthTick + 1; tick < later.tick(); ++tick)
            shader::stepParticle(compiled.parameters, nullptr, compiled.parameters.step, fields, 0,
                                 q);
        EXPECT_EQ(p.position, q.position);
    }
    // Spheres far away keep their places within the instance.
    const dvec3 far(1e6, -1e6, 1e6);
    const auto here = later.spheres(dmat4(1), 0, 0);
    const auto there = later.spheres(glm::translate(dmat4(1), far), 0, 0);
    ASSERT_EQ(here.size(), there.size());
    for (std::size_t i = 0; i < here.size(); ++i)
        EXPECT_LT(glm::length(there[i].center - far - here[i].center), 1e-5 * here[i].radius);
}

}  // namespace
}  // namespace brume::particles
