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
    const CompiledEffect compiled = compileEffect(effect)[0];
    const shader::RandomStream random = instanceParameters(11, 0, 0).random;
    for (std::uint32_t i = 0; i < kCount; ++i)
        visit(shader::spawnParticle(compiled.parameters, compiled.fieldValues.data(),
                                    compiled.triangles.data(), random, compiled.emitters[0], i, 1,
                                    0, vec3(0), vec3(0)));
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

TEST(SpawnShape, Disc_FillsItsAreaAcrossItsNormal) {
    std::array<int, 50> radial{}, azimuth{};
    const int n = visitSpawned(
        {.bursts = {}, .shape = scene::EmitterShape::Disc, .radius = 3, .normal = {0, 0, 1}},
        [&](const Particle& p) {
            const dvec3 d = dvec3(p.position) / 3.0;
            EXPECT_NEAR(d.z, 0, 1e-6);
            ++radial[binOf(d.x * d.x + d.y * d.y, 50)];
            ++azimuth[binOf(0.5 + std::atan2(d.y, d.x) / (2 * kPi), 50)];
        });
    expectUniform(radial, n);
    expectUniform(azimuth, n);
}

TEST(SpawnShape, Disc_LeavesItsInnerRadiusFree) {
    std::array<int, 50> radial{};
    const int n = visitSpawned(
        {.bursts = {}, .shape = scene::EmitterShape::Disc, .radius = 2, .innerRadius = 1},
        [&](const Particle& p) {
            const double r2 = p.position.x * p.position.x + p.position.z * p.position.z;
            ++radial[binOf((r2 - 1) / 3, 50)];
        });
    expectUniform(radial, n);
}

TEST(SpawnShape, LineAndRing_AreFilledEvenly) {
    std::array<int, 50> along{}, around{};
    int n = visitSpawned({.bursts = {},
                          .shape = scene::EmitterShape::Line,
                          .position = {1, 0, 0},
                          .size = {0, 3, 4}},
                         [&](const Particle& p) {
                             EXPECT_EQ(p.position.x, 1.0f);
                             ++along[binOf(p.position.y / 3, 50)];
                         });
    expectUniform(along, n);
    n = visitSpawned({.bursts = {}, .shape = scene::EmitterShape::Ring, .radius = 2},
                     [&](const Particle& p) {
                         EXPECT_NEAR(glm::length(p.position), 2, 1e-6);
                         ++around[binOf(0.5 + std::atan2(p.position.z, p.position.x) / (2 * kPi),
                                        50)];
                     });
    expectUniform(around, n);
}

TEST(SpawnShape, Surfaces_AreFilledByArea) {
    std::array<int, 50> height{};
    int n = visitSpawned(
        {.bursts = {}, .shape = scene::EmitterShape::Sphere, .radius = 2, .fromSurface = true},
        [&](const Particle& p) {
            EXPECT_NEAR(glm::length(p.position), 2, 1e-6);
            ++height[binOf(0.5 + p.position.y / 4.0, 50)];
        });
    expectUniform(height, n);

    // Faces of 2, 4 and 8 m^2 on either side: 28 m^2, in cells of 1 m^2.
    std::array<int, 28> cells{};
    n = visitSpawned({.bursts = {},
                      .shape = scene::EmitterShape::Box,
                      .size = {4, 2, 1},
                      .fromSurface = true},
                     [&](const Particle& p) {
                         const dvec3 q = dvec3(p.position) + dvec3(2, 1, 0.5);
                         const auto cell = [](double x, int last) {
                             return std::clamp(static_cast<int>(x), 0, last);
                         };
                         const bool isX = std::abs(std::abs(p.position.x) - 2) < 1e-6;
                         const bool isY = std::abs(std::abs(p.position.y) - 1) < 1e-6;
                         const int low = isX   ? cell(q.y, 1)
                                         : isY ? 2 + cell(q.x, 3)
                                               : 6 + cell(q.x, 3) * 2 + cell(q.y, 1);
                         const float side = isX   ? p.position.x
                                            : isY ? p.position.y
                                                  : p.position.z;
                         ++cells[static_cast<std::size_t>(low + (side > 0 ? 14 : 0))];
                     });
    expectUniform(cells, n);
}

TEST(SpawnShape, Cone_FillsVolumeAndMantle) {
    scene::Emitter emitter{
        .bursts = {}, .shape = scene::EmitterShape::Cone, .radius = 2, .height = 3};
    std::array<int, 50> part{}, radial{}, mantle{};
    int n = visitSpawned(emitter, [&](const Particle& p) {
        const double t = p.position.y / 3.0;
        const double r = std::hypot(p.position.x, p.position.z) / (2 * t);
        ++part[binOf(t * t * t, 50)];
        ++radial[binOf(r * r, 50)];
    });
    expectUniform(part, n);
    expectUniform(radial, n);
    emitter.fromSurface = true;
    n = visitSpawned(emitter, [&](const Particle& p) {
        const double t = p.position.y / 3.0;
        EXPECT_NEAR(std::hypot(p.position.x, p.position.z), 2 * t, 1e-5);
        ++mantle[binOf(t * t, 50)];
    });
    expectUniform(mantle, n);
}

TEST(SpawnShape, Mesh_IsFilledByAreaWithItsNormals) {
    // Triangles of 1/2 and 3/2 m^2 and one without area.
    scene::Emitter emitter{.bursts = {},
                           .shape = scene::EmitterShape::Mesh,
                           .speed = dvec2(1),
                           .velocity = scene::EmitterVelocity::Normal};
    emitter.triangles = std::make_shared<const std::vector<scene::EmitterTriangle>>(
        std::vector<scene::EmitterTriangle>{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                            {{5, 5, 5}, {6, 5, 5}, {7, 5, 5}},
                                            {{0, 0, 0}, {0, 3, 0}, {0, 0, 1}}});
    std::array<int, 4> quarters{};
    std::array<int, 20> strips{};
    int second = 0;
    const int n = visitSpawned(emitter, [&](const Particle& p) {
        const bool isFirst = p.velocity.z > 0.5f;
        EXPECT_LT(glm::length(p.velocity - (isFirst ? vec3(0, 0, 1) : vec3(1, 0, 0))), 1e-6);
        if (isFirst) return static_cast<void>(++quarters[0]);
        ++second;
        // Strips of equal area from the corner at the origin.
        const double s = p.position.y / 3.0 + p.position.z;
        ++strips[binOf(s * s, 20)];
    });
    EXPECT_NEAR(quarters[0], n / 4.0, 5 * std::sqrt(n * 0.25 * 0.75));
    expectUniform(strips, second);
}

TEST(SpawnVelocity, Radial_PointsAwayFromTheEmitter) {
    visitSpawned({.bursts = {},
                  .shape = scene::EmitterShape::Sphere,
                  .position = {3, 0, 0},
                  .radius = 2,
                  .speed = dvec2(2),
                  .velocity = scene::EmitterVelocity::Radial},
                 [&](const Particle& p) {
                     const dvec3 out = glm::normalize(dvec3(p.position) - dvec3(3, 0, 0));
                     EXPECT_LT(glm::length(dvec3(p.velocity) - 2.0 * out), 1e-5);
                 });
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
