// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <particles/cpu_simulation.hpp>

#include "effects.hpp"

namespace brume::particles {
namespace {

/// The angle by which one advected particle is off after a second of turning at 1 rad/s.
double angleError(double tickRate) {
    scene::Effect effect = burstEffect(1);
    effect.tickRate = tickRate;
    effect.emitters[0].position = {2, 0, 0};
    effect.modules = {fieldModule("velocity_field", "velocity")};
    addTestFields(effect);
    CpuSimulation simulation(effect, 1);
    simulation.step(static_cast<std::uint64_t>(tickRate));
    const vec3 p = simulation.particles()[0].position;
    EXPECT_NEAR(p.y, 0.5, 1e-3);
    // swirl() turns X towards -Z; its components are staggered along themselves alone.
    return std::abs(std::atan2(-p.z, p.x) - 1);
}

TEST(Fields, Advection_IsOfSecondOrder) {
    const double coarse = angleError(4), fine = angleError(8);
    EXPECT_LT(fine, 0.01);
    EXPECT_NEAR(coarse / fine, 4, 1);
}

TEST(Fields, StaggeredComponents_SitHalfAVoxelBelow) {
    scene::Effect effect = burstEffect(1);
    addTestFields(effect);
    scene::FieldValues field = *makeField(9, 3, [](const dvec3& p) { return p; });  // 1 m voxels
    const auto velocityAtOrigin = [&](bool isStaggered) {
        field.isStaggered = isStaggered;
        effect.fields[{"test.vdb", "velocity", -1}] =
            std::make_shared<const scene::FieldValues>(field);
        effect.emitters[0].velocityField = placeField("velocity");
        CpuSimulation simulation(effect, 1);
        simulation.step(1);
        return simulation.particles()[0].velocity;
    };
    EXPECT_EQ(velocityAtOrigin(false), vec3(0));
    // The value of voxel i holds at i - 1/2.
    EXPECT_EQ(velocityAtOrigin(true), vec3(0.5));
}

TEST(Fields, Buoyancy_IsLinearInTheTemperature) {
    scene::Effect effect = burstEffect(1);
    effect.emitters[0].position = {0, 2, 0};
    effect.modules = {fieldModule("buoyancy", "temperature",
                                  {{"lift", {0, 3, 0}}, {"ambient", {0.2}}})};
    addTestFields(effect);
    CpuSimulation simulation(effect, 1);
    simulation.step(1);
    const double acceleration = 3 * (2 - 0.4 * 2 - 0.2);
    EXPECT_NEAR(simulation.particles()[0].velocity.y, acceleration / 120, 1e-6);
}

TEST(Fields, BirthsInADensity_FollowItsTrilinearValues) {
    scene::Effect effect = burstEffect(60000);
    effect.emitters[0].shape = scene::EmitterShape::Volume;
    effect.emitters[0].volume = placeField("density");
    addTestFields(effect);
    // Density 1 + x/4 over the whole box: the marginal along x is linear between the faces.
    effect.fields[{"test.vdb", "density", -1}] =
        makeField(9, 1, [](const dvec3& p) { return dvec3(1 + p.x / 4); });
    CpuSimulation simulation(effect, 3);
    simulation.step(1);
    constexpr int kBins = 6;  // of 1 m, from -3 to 3, where no face is near
    double counts[kBins] = {}, all = 0;
    for (const Particle& p : simulation.particles())
        if (p.position.x >= -3 && p.position.x < 3)
            ++counts[static_cast<int>(p.position.x + 3)], ++all;
    double chi2 = 0;
    for (int i = 0; i < kBins; ++i) {
        const double middle = -2.5 + i;
        const double wanted = all * (1 + middle / 4) / kBins;
        chi2 += (counts[i] - wanted) * (counts[i] - wanted) / wanted;
    }
    EXPECT_LT(chi2, 20.5);  // 5 degrees of freedom, p = 0.001
}

TEST(Fields, BirthsOnALevelSet_AreUniformByArea) {
    constexpr int kBands = 12, kSegments = 24, kSectors = 6;
    const auto corner = [](int band, int segment) {
        const double polar = kPi * band / kBands, around = 2 * kPi * segment / kSegments;
        return 1.2 * dvec3(std::sin(polar) * std::cos(around), std::cos(polar),
                           std::sin(polar) * std::sin(around));
    };
    scene::Effect effect = burstEffect(60000);
    effect.emitters[0].shape = scene::EmitterShape::Volume;
    effect.emitters[0].volume = placeField("ball");
    addTestFields(effect);
    scene::FieldValues ball = *effect.fields.at({"test.vdb", "ball", -1});
    ball.surface.clear();
    double areas[kBands][kSectors] = {}, all = 0;
    for (int band = 0; band < kBands; ++band)
        for (int segment = 0; segment < kSegments; ++segment) {
            const dvec3 a = corner(band, segment), b = corner(band, segment + 1),
                        c = corner(band + 1, segment + 1), d = corner(band + 1, segment);
            for (const scene::EmitterTriangle& t :
                 {scene::EmitterTriangle{a, b, c}, scene::EmitterTriangle{a, c, d}}) {
                const double area = glm::length(glm::cross(t.b - t.a, t.c - t.a)) / 2;
                if (area < 1e-9) continue;
                ball.surface.push_back(t);
                areas[band][segment * kSectors / kSegments] += area;
                all += area;
            }
        }
    effect.fields[{"test.vdb", "ball", -1}] =
        std::make_shared<const scene::FieldValues>(std::move(ball));
    CpuSimulation simulation(effect, 3);
    simulation.step(1);
    double counts[kBands][kSectors] = {};
    for (const Particle& p : simulation.particles()) {
        // Bands are flat: their borders are circles of one height.
        const double polar = std::acos(std::clamp(p.position.y / 1.2, -1.0, 1.0));
        const double around = std::atan2(p.position.z, p.position.x) / (2 * kPi);
        const auto band = static_cast<int>(polar / kPi * kBands);
        const auto sector = static_cast<int>((around < 0 ? around + 1 : around) * kSectors);
        ++counts[std::min(band, kBands - 1)][std::min(sector, kSectors - 1)];
    }
    double chi2 = 0;
    for (int band = 0; band < kBands; ++band)
        for (int sector = 0; sector < kSectors; ++sector) {
            const double wanted = 60000 * areas[band][sector] / all;
            chi2 += (counts[band][sector] - wanted) * (counts[band][sector] - wanted) / wanted;
        }
    EXPECT_LT(chi2, 112.3);  // 71 degrees of freedom, p = 0.001
}

TEST(Fields, FastParticles_DoNotPassALevelSet) {
    scene::Effect effect = burstEffect(5000, 500, {1, 0, 0});
    effect.emitters[0].shape = scene::EmitterShape::Disc;
    effect.emitters[0].radius = 0.9;
    effect.emitters[0].normal = {1, 0, 0};
    effect.emitters[0].position = {-3.4, 0, 0};
    effect.modules = {fieldModule("collide_level_set", "ball", {{"restitution", {1}},
                                                               {"friction", {0}}})};
    addTestFields(effect);
    CpuSimulation simulation(effect, 1);
    for (int i = 0; i < 10; ++i) {
        simulation.step(1);
        for (const Particle& p : simulation.particles())
            ASSERT_GT(glm::length(p.position), 1.19f) << "tick " << i;
    }
    // Nothing comes out straight behind the ball.
    for (const Particle& p : simulation.particles())
        EXPECT_FALSE(p.velocity.x > 499.9f && std::hypot(p.position.y, p.position.z) < 0.9f);
}

TEST(Fields, ParticlesOnALevelSet_ComeToRest) {
    scene::Effect effect = burstEffect(1);
    effect.emitters[0].position = {0, 1.5, 0};
    effect.modules = {moduleSettings("gravity"),
                      fieldModule("collide_level_set", "ball", {{"restitution", {0.2}}})};
    addTestFields(effect);
    CpuSimulation simulation(effect, 1);
    simulation.step(240);
    EXPECT_NEAR(simulation.particles()[0].position.y, 1.2, 0.02);
    EXPECT_LT(glm::length(simulation.particles()[0].velocity), 0.2f);
}

}  // namespace
}  // namespace brume::particles
