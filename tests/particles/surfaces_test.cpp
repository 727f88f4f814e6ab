// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <particles/cpu_simulation.hpp>
#include <particles/surfaces.hpp>

#include "effects.hpp"

#include <algorithm>

namespace brume::particles {
namespace {

scene::CameraFrame frontCamera() {
    return scene::makeCameraFrame({.position = {0, 0, 10}, .target = {0, 0, 0}}, 64, 64);
}

scene::Material thinMaterial() {
    scene::Material material;
    material.type = scene::MaterialType::Thin;
    material.transmission = dvec3(1);
    material.emission = dvec3(2);
    return material;
}

scene::Mesh meshOf(const CpuSimulation& simulation, const scene::Effect& effect,
                   std::uint32_t population) {
    const SimulationState state = simulation.state();
    return makeSurfaceMesh({.effect = effect,
                            .compiled = simulation.effect(population),
                            .state = state,
                            .population = population,
                            .random = instanceParameters(1, 0, population).random,
                            .sinceTick = 0},
                           dmat4(1), frontCamera(), 3);
}

/// Three parents that fly apart, with trails.
scene::Effect parentsWithTrails() {
    auto trail = std::make_shared<scene::Effect>(burstEffect(1));
    trail->capacity = 1000;
    trail->emitters = {{.lifetime = dvec2(0.5)}};
    trail->surface = scene::Surface{};
    trail->radius = {{{0, 0.02}}};
    scene::Effect effect = burstEffect(3, 2);
    effect.emitters[0].spread = 1;
    effect.subEmitters = {{.trigger = scene::SubEmitterTrigger::Way, .rate = 30, .effect = trail}};
    return effect;
}

TEST(Ribbons, OfTrails_ConnectEachParentsOwnInOrderOfBirth) {
    const scene::Effect effect = parentsWithTrails();
    CpuSimulation simulation(effect, 1);
    simulation.step(60);
    ASSERT_EQ(simulation.strands(1).size(), simulation.particles(1).size());
    for (const std::uint32_t strand : simulation.strands(1)) EXPECT_LT(strand, 3u);

    const scene::Mesh mesh = meshOf(simulation, *effect.subEmitters[0].effect, 1);
    const std::size_t points = simulation.particles(1).size() + 3;  // and the parents
    ASSERT_EQ(mesh.positions.size(), 2 * points);
    EXPECT_EQ(mesh.indices.size(), 6 * (points - 3));
    // Two triangles share two corners of the point before: no ribbon jumps to another parent, which
    // would be wider than the way of a 30th of a second.
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto at = [&](std::size_t k) { return mesh.positions[mesh.indices[i + k]]; };
        for (int k = 0; k < 3; ++k)
            EXPECT_LT(glm::length(at(k) - at((k + 1) % 3)), 2.0f / 30 + 0.05f);
    }
    for (std::size_t i = 0; i < mesh.positions.size(); i += 2)
        EXPECT_NEAR(glm::length(mesh.positions[i] - mesh.positions[i + 1]), 0.04f, 1e-5f);
}

TEST(Ribbons, StrandsOfACheckpoint_ComeBack) {
    const scene::Effect effect = parentsWithTrails();
    CpuSimulation simulation(effect, 1), other(effect, 1);
    simulation.step(60);
    const CheckpointKey key{fingerprintOf(compileEffect(effect)), 1, 0};
    const auto file = std::filesystem::path(testing::TempDir()) / "brume_ribbon.checkpoint";
    writeCheckpoint(file, key, simulation.state());
    other.restore(readCheckpoint(file, key, compileEffect(effect)));
    std::filesystem::remove(file);
    simulation.step(30);
    other.step(30);
    EXPECT_EQ(other.hash(), simulation.hash());
    EXPECT_EQ(other.strands(1), simulation.strands(1));
}

TEST(Ribbons, Material_HasDensityAndTintOverLife) {
    scene::Effect effect = burstEffect(1);
    effect.surface = scene::Surface{};
    effect.density = {{{0, 1}, {1, 0}}};
    effect.tint = {{{0, dvec3(4, 1, 0)}}};
    effect.smoothProfile = true;
    const scene::Material material = makeSurfaceMaterial(thinMaterial(), effect);
    const scene::Texture& color = *material.colorTexture;
    const vec4& middle = color.texels[static_cast<std::size_t>(7) * color.width];
    EXPECT_NEAR(middle.a, 1, 0.02);
    EXPECT_NEAR(color.texels[0].a, 0, 1e-6);                              // the edge
    EXPECT_NEAR(color.texels[static_cast<std::size_t>(8) * color.width - 1].a, 0, 1e-6);  // death
    EXPECT_EQ(vec3(middle), vec3(1, 1, 0));
    EXPECT_EQ(vec3(material.emissionTexture->texels[0]), vec3(4, 1, 0));
}

TEST(Billboards, Film_BlendsNeighbouringFrames) {
    scene::Effect effect = burstEffect(1);
    effect.surface = scene::Surface{.type = scene::SurfaceType::Billboard, .columns = 2};
    auto atlas = std::make_shared<scene::Texture>();
    atlas->width = 16;
    atlas->height = 8;
    for (int i = 0; i < 128; ++i) atlas->texels.push_back(vec4(i % 16 < 8 ? 0.0f : 1.0f));
    for (vec4& texel : atlas->texels) texel.a = 1;
    scene::Material base = thinMaterial();
    base.colorTexture = atlas;
    const scene::Material film = makeSurfaceMaterial(base, effect);
    const scene::Texture& sheet = *film.colorTexture;
    // 32 pictures in 6 columns of 8 texels, from frame 0 to frame 1.
    ASSERT_EQ(sheet.width, 48);
    for (int cell = 0; cell < 32; ++cell) {
        const std::size_t x = static_cast<std::size_t>(cell % 6) * 8 + 4, y = cell / 6 * 8 + 4;
        EXPECT_NEAR(sheet.texels[y * 48 + x].x, (cell + 0.5) / 32, 1e-5) << cell;
    }
}

TEST(Billboards, Rotation_TurnsTheCorners) {
    scene::Effect effect = burstEffect(1);
    effect.surface = scene::Surface{.type = scene::SurfaceType::Billboard};
    effect.surface->rotation = {{{0, kPi / 4}}};
    effect.radius = {{{0, 0.5}}};
    CpuSimulation simulation(effect, 1);
    simulation.step(1);
    const scene::Mesh mesh = meshOf(simulation, effect, 0);
    ASSERT_EQ(mesh.positions.size(), 4u);
    const auto corner = [&](int i) {
        return transformPoint(mesh.worldFromObject, dvec3(mesh.positions[i]));
    };
    // The lower left corner has become the lowest one.
    EXPECT_NEAR(corner(0).x, 0, 1e-6);
    EXPECT_NEAR(corner(0).y, -std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(corner(2).y, std::sqrt(0.5), 1e-6);
    EXPECT_EQ(mesh.normals[0], vec3(0, 0, 1));
    EXPECT_EQ(mesh.material, 3u);
}

}  // namespace
}  // namespace brume::particles
