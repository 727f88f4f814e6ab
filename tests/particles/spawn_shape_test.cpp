// SPDX-License-Identifier: Apache-2.0
// Where particles are born and where they fly to, as distributions.
#include <gtest/gtest.h>
#include <shaders/particles/spawn.h>
#include <particles/cpu_simulation.hpp>

#include "effects.hpp"

#include <array>

namespace brume::particles {
namespace {

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
