// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <shaders/particles/spawn.h>
#include <particles/cpu_simulation.hpp>

#include "effects.hpp"

#include <array>
#include <random>

namespace brume::particles {
namespace {

scene::Effect rateEffect(double rate, double tickRate) {
    scene::Effect effect;
    effect.capacity = 1u << 20u;
    effect.tickRate = tickRate;
    effect.emitters = {{.rate = rate, .bursts = {}, .lifetime = dvec2(1e6)}};
    return effect;
}

TEST(Spawn, AnyRateAndTickRate_GivesTheExactNumber) {
    for (const double tickRate : {24.0, 60.0, 119.88, 144.0, 1000.0})
        for (const double rate : {0.25, 1.0, 7.0, 23.976, 1000.0 / 3, 60.0, 2000.0, 12345.678}) {
            SpawnSchedule schedule(rateEffect(rate, tickRate));
            std::uint64_t born = 0;
            for (int tick = 1; tick <= 3000; ++tick) {
                born += schedule.next().count;
                const double exact = rate * tick / tickRate;
                ASSERT_LE(static_cast<double>(born), exact * (1 + 1e-7) + 1e-6) << rate << tickRate;
                ASSERT_GT(static_cast<double>(born), exact * (1 - 1e-7) - 1 - 1e-6)
                    << rate << tickRate;
            }
        }
}

TEST(Spawn, AnyFrameSlicing_GivesTheSameBits) {
    constexpr double kSeconds = 2;
    CpuSimulation whole(busyEffect(), 3);
    whole.advanceTo(kSeconds);
    for (const int framesPerSecond : {24, 25, 30, 60, 144}) {
        CpuSimulation sliced(busyEffect(), 3);
        for (int frame = 1; frame <= kSeconds * framesPerSecond; ++frame)
            sliced.advanceTo(static_cast<double>(frame) / framesPerSecond);
        EXPECT_EQ(sliced.hash(), whole.hash()) << framesPerSecond;
    }
    std::mt19937 generator(9);
    CpuSimulation random(busyEffect(), 3);
    for (double time = 0; time < kSeconds;) {
        random.advanceTo(time);
        time += std::uniform_real_distribution<double>(0, 0.1)(generator);
    }
    random.advanceTo(kSeconds);
    EXPECT_EQ(random.hash(), whole.hash());
    random.advanceTo(1);
    random.advanceTo(kSeconds);
    EXPECT_EQ(random.hash(), whole.hash());
}

TEST(Spawn, BirthsWithinTicks_LieAtTheirTimes) {
    // A steady jet without forces: particle i was born at (i + 1) / rate and has flown since.
    scene::Effect effect = rateEffect(77, 10);
    effect.emitters[0].speed = dvec2(3);
    CpuSimulation simulation(effect, 1);
    simulation.advanceTo(4);
    ASSERT_EQ(simulation.particles().size(), 308u);
    for (const Particle& p : simulation.particles())
        EXPECT_NEAR(p.position.y, 3 * (4 - (p.birthIndex + 1) / 77.0), 2e-5) << p.birthIndex;
}

TEST(Spawn, Durations_EndRateAndBursts) {
    scene::Effect effect = rateEffect(100, 120);
    effect.emitters[0].duration = 0.7;
    effect.emitters[0].bursts = {{0, 5}, {0.7, 6}, {0.8, 1000}};
    CpuSimulation simulation(effect, 1);
    simulation.advanceTo(5);
    EXPECT_EQ(simulation.counters().born, 70u + 5 + 6);
}

TEST(Spawn, Burst_IsBornAtItsTime) {
    scene::Effect effect = burstEffect(1, 1);
    effect.emitters[0].bursts = {{0.123, 1}};
    CpuSimulation simulation(effect, 1);
    simulation.advanceTo(0.12);
    EXPECT_EQ(simulation.counters().alive, 0u);
    simulation.advanceTo(1);
    ASSERT_EQ(simulation.counters().alive, 1u);
    EXPECT_NEAR(simulation.particles()[0].position.y, 1 - 0.123, 1e-6);
}

TEST(Spawn, Survivors_KeepTheirOrderOfBirth) {
    CpuSimulation simulation(busyEffect(), 1);
    for (int i = 0; i < 60; ++i) {
        simulation.step(10);
        const auto& particles = simulation.particles();
        for (std::size_t j = 1; j < particles.size(); ++j)
            ASSERT_LT(particles[j - 1].birthIndex, particles[j].birthIndex);
        const Counters& c = simulation.counters();
        ASSERT_EQ(c.alive, c.born - c.died);
        ASSERT_EQ(c.alive, particles.size());
    }
    EXPECT_GT(simulation.counters().died, 3000u);
}

TEST(Spawn, Particles_DieAtTheirLifetime) {
    scene::Effect effect = rateEffect(1000, 100);
    effect.emitters[0].lifetime = dvec2(0.5);
    CpuSimulation simulation(effect, 1);
    simulation.advanceTo(0.49);
    EXPECT_EQ(simulation.counters().alive, 490u);
    simulation.advanceTo(3);
    EXPECT_NEAR(simulation.counters().alive, 500, 1);
    EXPECT_EQ(simulation.counters().born, 3000u);
}

TEST(Spawn, FullCapacity_KeepsTheFirstAndCountsTheRest) {
    scene::Effect effect = burstEffect(1000);
    effect.capacity = 100;
    effect.emitters.push_back({.rate = 120, .bursts = {}, .lifetime = dvec2(1e6)});
    CpuSimulation simulation(effect, 1);
    simulation.step(50);
    EXPECT_EQ(simulation.counters().alive, 100u);
    EXPECT_EQ(simulation.counters().born, 100u);
    EXPECT_EQ(simulation.counters().rejected, 950u);
    for (std::uint32_t i = 0; i < 100; ++i) EXPECT_EQ(simulation.particles()[i].birthIndex, i);
}

// Chi-square of n samples over equally likely bins, against five standard deviations.
template <std::size_t Bins>
void expectUniform(const std::array<int, Bins>& bins, int n) {
    const double expected = static_cast<double>(n) / Bins;
    double chiSquare = 0;
    for (const int count : bins) chiSquare += (count - expected) * (count - expected) / expected;
    EXPECT_LT(chiSquare, Bins - 1 + 5 * std::sqrt(2.0 * (Bins - 1)));
}

template <typename Visit>
int visitSpawned(const scene::Emitter& emitter, Visit&& visit) {
    constexpr int kCount = 100000;
    scene::Effect effect;
    effect.emitters = {emitter};
    const CompiledEffect compiled = compileEffect(effect, 11, 0);
    const shader::BirthBatch batch{0, 0, kCount, 1, 0};
    for (std::uint32_t i = 0; i < kCount; ++i)
        visit(shader::spawnParticle(compiled.parameters.random, compiled.emitters[0], batch, i, 0));
    return kCount;
}

std::size_t binOf(double unit, std::size_t bins) {
    EXPECT_GE(unit, -1e-6);
    EXPECT_LE(unit, 1 + 1e-6);
    return std::min(bins - 1,
                    static_cast<std::size_t>(std::max(0.0, unit) * static_cast<double>(bins)));
}

TEST(SpawnShape, Sphere_FillsItsVolumeUniformly) {
    std::array<int, 50> radial{}, height{}, azimuth{};
    const scene::Emitter emitter{.bursts = {},
                                 .shape = scene::EmitterShape::Sphere,
                                 .position = {1, 2, 3},
                                 .radius = 2,
                                 .direction = glm::normalize(dvec3(1, 2, -1))};
    const int n = visitSpawned(emitter, [&](const Particle& p) {
        const dvec3 d = (dvec3(p.position) - dvec3(1, 2, 3)) / 2.0;
        const double r = glm::length(d);
        ++radial[binOf(r * r * r, 50)];
        ++height[binOf(0.5 + 0.5 * d.z / r, 50)];
        ++azimuth[binOf(0.5 + std::atan2(d.y, d.x) / (2 * kPi), 50)];
    });
    expectUniform(radial, n);
    expectUniform(height, n);
    expectUniform(azimuth, n);
}

TEST(SpawnShape, Box_FillsItsVolumeUniformly) {
    std::array<int, 50> x{}, y{}, z{};
    const int n = visitSpawned({.bursts = {}, .shape = scene::EmitterShape::Box, .size = {1, 2, 4}},
                               [&](const Particle& p) {
                                   ++x[binOf(p.position.x + 0.5, 50)];
                                   ++y[binOf(p.position.y / 2.0 + 0.5, 50)];
                                   ++z[binOf(p.position.z / 4.0 + 0.5, 50)];
                               });
    expectUniform(x, n);
    expectUniform(y, n);
    expectUniform(z, n);
}

TEST(SpawnShape, Disc_FillsItsAreaAcrossTheDirection) {
    std::array<int, 50> radial{}, azimuth{};
    const int n = visitSpawned(
        {.bursts = {}, .shape = scene::EmitterShape::Disc, .radius = 3, .direction = {0, 0, 1}},
        [&](const Particle& p) {
            const dvec3 d = dvec3(p.position) / 3.0;
            EXPECT_NEAR(d.z, 0, 1e-6);
            ++radial[binOf(d.x * d.x + d.y * d.y, 50)];
            ++azimuth[binOf(0.5 + std::atan2(d.y, d.x) / (2 * kPi), 50)];
        });
    expectUniform(radial, n);
    expectUniform(azimuth, n);
}

TEST(SpawnVelocity, Spread_FillsTheConeUniformly) {
    std::array<int, 50> height{}, azimuth{}, speed{};
    const double spread = 0.3;
    const int n =
        visitSpawned({.bursts = {}, .speed = {1, 2}, .direction = {0, 0, 5}, .spread = spread},
                     [&](const Particle& p) {
                         const double length = glm::length(dvec3(p.velocity));
                         ++speed[binOf(length - 1, 50)];
                         const dvec3 d = dvec3(p.velocity) / length;
                         ++height[binOf((1 - d.z) / (1 - std::cos(spread)), 50)];
                         ++azimuth[binOf(0.5 + std::atan2(d.y, d.x) / (2 * kPi), 50)];
                     });
    expectUniform(height, n);
    expectUniform(azimuth, n);
    expectUniform(speed, n);
}

}  // namespace
}  // namespace brume::particles
