// SPDX-License-Identifier: Apache-2.0
// When particles are born and how they end.
#include <gtest/gtest.h>
#include <shaders/particles/spawn.h>
#include <particles/cpu_simulation.hpp>

#include "effects.hpp"

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
                born += schedule.at(static_cast<std::uint64_t>(tick - 1)).count;
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

TEST(Spawn, AnyFrameSlicingOfEverything_GivesTheSameBits) {
    constexpr double kSeconds = 1.5;
    CpuSimulation whole(fullEffect(600), 3);
    whole.advanceTo(kSeconds);
    for (const int framesPerSecond : {24, 30, 60, 144}) {
        CpuSimulation sliced(fullEffect(600), 3);
        for (int frame = 1; frame <= kSeconds * framesPerSecond; ++frame)
            sliced.advanceTo(static_cast<double>(frame) / framesPerSecond);
        EXPECT_EQ(sliced.hash(), whole.hash()) << framesPerSecond;
    }
}

TEST(Spawn, Durations_EndRateAndBursts) {
    scene::Effect effect = rateEffect(100, 120);
    effect.emitters[0].duration = 0.7;
    effect.emitters[0].bursts = {{0, 5}, {0.7, 6}, {0.8, 1000}};
    CpuSimulation simulation(effect, 1);
    simulation.advanceTo(5);
    EXPECT_EQ(simulation.counters().born, 70u + 5 + 6);
}

// Lifetime, place and velocity of births: between instances, seeds, neighbours in order of birth and
// the components of one particle. p = 0.001 over all, divided by the number of tests (Bonferroni).
TEST(Spawn, InstancesSeedsAndNeighbours_AreUncorrelated) {
    constexpr std::uint32_t kCount = 20000;
    scene::Effect effect = burstEffect(kCount);
    effect.emitters[0].shape = scene::EmitterShape::Box;
    effect.emitters[0].size = dvec3(1);
    effect.emitters[0].speed = {0, 1};
    effect.emitters[0].spread = kPi;
    effect.emitters[0].lifetime = {1, 2};

    std::vector<std::vector<double>> series;
    for (const auto& [seed, instance] : {std::pair{5, 0}, {5, 1}, {5, 2}, {6, 0}, {5 << 8, 1}}) {
        const CompiledEffect compiled = compileEffect(effect)[0];
        const auto random = instanceParameters(seed, instance, 0).random;
        std::vector<std::vector<double>> own(5);
        for (std::uint32_t i = 0; i < kCount; ++i) {
            const Particle p =
                shader::spawnParticle(compiled.parameters, nullptr, nullptr, random,
                                      compiled.emitters[0], i, 1, 0, vec3(0), vec3(0));
            const double values[] = {p.position.x, p.position.y, p.velocity.x, p.velocity.z,
                                     p.life.lifetimeTicks};
            for (int k = 0; k < 5; ++k) own[k].push_back(values[k]);
        }
        series.insert(series.end(), own.begin(), own.end());
    }
    for (std::vector<double>& s : series) {  // mean 0, variance 1
        double mean = 0, square = 0;
        for (const double v : s) mean += v / kCount;
        for (double& v : s) v -= mean;
        for (const double v : s) square += v * v / kCount;
        for (double& v : s) v /= std::sqrt(square);
    }
    // 25 series, each with all others and with all (itself included) one and seven births later:
    // 300 + 2 * 625 tests, |z| < 4.98.
    const auto z = [&](std::size_t a, std::size_t b, std::uint32_t shift) {
        double sum = 0;
        for (std::uint32_t i = 0; i + shift < kCount; ++i) sum += series[a][i] * series[b][i + shift];
        return sum / std::sqrt(static_cast<double>(kCount - shift));
    };
    for (std::size_t a = 0; a < series.size(); ++a)
        for (std::size_t b = 0; b < series.size(); ++b) {
            if (a < b) {
                EXPECT_LT(std::abs(z(a, b, 0)), 4.98) << a << " " << b;
            }
            EXPECT_LT(std::abs(z(a, b, 1)), 4.98) << a << " " << b;
            EXPECT_LT(std::abs(z(a, b, 7)), 4.98) << a << " " << b;
        }
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

TEST(Spawn, RepeatedBursts_ComeAtTheirTimesAndEnd) {
    scene::Effect effect = burstEffect(1, 1);
    effect.capacity = 1000;
    effect.emitters[0].bursts = {{0.1, 3, 5, 0.25}};
    effect.emitters[0].delay = 0.4;
    CpuSimulation simulation(effect, 1);
    for (const auto& [time, born] : std::vector<std::pair<double, std::uint32_t>>{
             {0.49, 0}, {0.51, 3}, {0.74, 3}, {0.76, 6}, {1.49, 12}, {1.51, 15}, {9, 15}}) {
        simulation.advanceTo(time);
        EXPECT_EQ(simulation.counters().born, born) << time;
    }
    for (const Particle& p : simulation.particles())
        EXPECT_NEAR(p.position.y, 9 - (0.5 + 0.25 * (p.birthIndex / 3)), 1e-4);
}

TEST(Spawn, Delay_ShiftsRateAndDuration) {
    scene::Effect effect = rateEffect(100, 119.88);
    effect.emitters[0].delay = 1.2345;
    effect.emitters[0].duration = 2;
    effect.emitters[0].speed = dvec2(1);
    CpuSimulation simulation(effect, 1);
    simulation.step(600);
    EXPECT_EQ(simulation.counters().born, 200u);
    const double now = 600 / 119.88;
    for (const Particle& p : simulation.particles())
        EXPECT_NEAR(p.position.y, now - (1.2345 + (p.birthIndex + 1) / 100.0), 1e-4);
}

TEST(Spawn, MovingEmitter_LeavesBirthsAlongItsWay) {
    scene::Effect effect = rateEffect(1000, 60);
    effect.emitters[0].path = {{0, dvec3(0)}, {1, dvec3(6, 0, 0)}, {2, dvec3(6, 3, 0)}};
    effect.emitters[0].inherit = 0.5;
    CpuSimulation simulation(effect, 1);
    simulation.advanceTo(1);
    ASSERT_EQ(simulation.particles().size(), 1000u);
    for (const Particle& p : simulation.particles()) {
        const double born = (p.birthIndex + 1) / 1000.0;
        EXPECT_NEAR(p.position.x, 6 * born + 3 * (1 - born), 1e-4);  // takes over half the speed
        EXPECT_NEAR(p.velocity.x, 3, 1e-5);
    }
}

TEST(Spawn, AnyTick_CanBeAskedForAlone) {
    const SpawnSchedule schedule(fullEffect());
    std::uint64_t born = 0;
    for (std::uint64_t tick = 0; tick < 400; ++tick) {
        ASSERT_EQ(schedule.birthsBefore(tick), born) << tick;
        const TickBirths births = schedule.at(tick);
        born += births.count + births.overflow;
        for (const shader::BirthBatch& batch : births.batches) {
            ASSERT_GE(batch.remaining, 0.0f);
            ASSERT_LE(batch.remaining, 1.0f);
        }
    }
    EXPECT_LE(schedule.at(20736000).batches.size(), schedule.maxBatchesPerTick());
}

TEST(Spawn, After48Hours_MotionIsThatOfTheStart) {
    // Two bursts of the same birth indices cannot be; the same places and speeds can.
    scene::Effect effect = burstEffect(1, 3, {1, 1, 0});
    effect.modules = {moduleSettings("gravity"), moduleSettings("drag")};
    const auto after = [&](double start) {
        effect.emitters[0].bursts = {{start, 1}};
        CpuSimulation simulation(effect, 1);
        simulation.advanceTo(start + 2);
        return simulation.particles().at(0);
    };
    const Particle early = after(0.25), late = after(48 * 3600 + 0.25);
    EXPECT_EQ(early.position, late.position);
    EXPECT_EQ(early.velocity, late.velocity);
}

}  // namespace
}  // namespace brume::particles
