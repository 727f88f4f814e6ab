// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <core/error.hpp>
#include <volumes/vdb_file.hpp>

#include "vdb_writer.hpp"

#include <fstream>

namespace brume::volumes {
namespace {

using test::TestGrid;
using test::writeVdb;

/// An effect with one module that samples that grid of the file.
scene::Effect effectWith(const std::filesystem::path& file, const std::string& grid) {
    scene::Effect effect;
    effect.modules = {{.type = "buoyancy",
                       .values = {},
                       .texts = {{"file", file.string()}, {"grid", grid}},
                       .whereOf = {{"file", "e.json:4:9"}},
                       .where = "e.json:4:1"}};
    return effect;
}

std::string messageOf(const std::filesystem::path& file, const std::string& grid) {
    scene::Effect effect = effectWith(file, grid);
    try {
        loadEffectFields(effect);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Input);
        return error.what();
    }
    return "no error";
}

std::filesystem::path temporaryFile(const std::string& name) {
    return std::filesystem::path(testing::TempDir()) / name;
}

TEST(VdbField, Scalars_LieInTheirBoxAndInactiveOnesAreZero) {
    const auto file = temporaryFile("brume_field.vdb");
    TestGrid grid;
    grid.name = "heat";
    grid.background = 5;
    grid.worldFromIndex = glm::scale(dmat4(1), dvec3(0.5));
    grid.voxels = {{{-2, 3, 1}, 7}, {{0, 3, 2}, std::nan("")}, {{-1, 3, 1}, 9, false}};
    writeVdb(file, {grid});
    scene::Effect effect = effectWith(file, "heat");
    loadEffectFields(effect);
    std::filesystem::remove(file);
    const scene::FieldValues& field = *effect.fields.begin()->second;
    EXPECT_EQ(field.lo, ivec3(-2, 3, 1));
    EXPECT_EQ(field.size, ivec3(3, 1, 2));
    EXPECT_EQ(field.background, 5);
    EXPECT_EQ(field.fileFromIndex, grid.worldFromIndex);
    EXPECT_EQ(field.values, (std::vector<float>{7, 0, 0, 0, 0, 0}));
}

TEST(VdbField, StaggeredVelocities_AreKnownAsSuch) {
    scene::Effect effect = effectWith(BRUME_SOURCE_DIR "/demos/plume/fire.vdb", "velocity");
    loadEffectFields(effect);
    const scene::FieldValues& field = *effect.fields.begin()->second;
    EXPECT_TRUE(field.isStaggered);
    EXPECT_EQ(field.componentCount, 3);
    EXPECT_EQ(field.size, ivec3(30, 30, 41));
    double largest = 0;
    for (std::size_t i = 0; i < field.values.size(); i += 3)
        largest = std::max(largest, glm::length(dvec3(field.values[i], field.values[i + 1],
                                                      field.values[i + 2])));
    EXPECT_NEAR(largest, 107.506, 0.001);  // as brume inspect prints it
}

TEST(VdbField, LevelSets_HaveASurfaceThatFacesOutwards) {
    const auto file = temporaryFile("brume_ball.vdb");
    TestGrid grid;
    grid.gridClass = "level set";
    grid.background = 3;
    for (int x = -8; x <= 8; ++x)
        for (int y = -8; y <= 8; ++y)
            for (int z = -8; z <= 8; ++z) {
                const double distance = glm::length(dvec3(x, y, z)) - 5;
                if (std::abs(distance) < 3) grid.voxels.push_back({{x, y, z}, distance});
            }
    writeVdb(file, {grid});
    scene::Effect effect = effectWith(file, "density");
    loadEffectFields(effect);
    std::filesystem::remove(file);
    const scene::FieldValues& field = *effect.fields.begin()->second;
    EXPECT_TRUE(field.isLevelSet);
    double volume = 0;
    for (const scene::EmitterTriangle& t : field.surface)
        volume += glm::dot(t.a, glm::cross(t.b, t.c)) / 6;
    // Flat faces a fifth of the radius wide lie inside the ball; turned inwards it would be negative.
    EXPECT_NEAR(volume, 4.0 / 3 * kPi * 125, 60);
}

TEST(VdbField, Faults_AreNamedAtTheirPlace) {
    const std::string fire = BRUME_SOURCE_DIR "/demos/plume/fire.vdb";
    EXPECT_EQ(messageOf(fire, "heat").find("loading volume: e.json:4:9: " + fire +
                                           ": it has no grid \"heat\", it has \"velocity\"[0]"),
              0u);
    EXPECT_EQ(messageOf(fire + "x", "heat").find("loading volume: e.json:4:9: " + fire + "x: "), 0u);
    const auto file = temporaryFile("brume_wide.vdb");
    TestGrid grid;
    grid.voxels = {{{-1000000, 0, 0}, 1}, {{1000000, 50, 50}, 1}};
    writeVdb(file, {grid});
    EXPECT_NE(messageOf(file, "density").find("at most 33554432 values are allowed"),
              std::string::npos);
    std::filesystem::remove(file);
}

}  // namespace
}  // namespace brume::volumes
