// SPDX-License-Identifier: Apache-2.0
// Files that the test writes itself, with the libraries that define the formats.
#include <volumes/support.hpp>
#include <volumes/vdb_writer.hpp>

#include <algorithm>
#include <fstream>
#include <limits>

namespace brume::volumes::test {
namespace {

TestGrid makeBlob(int radius = 10) {
    TestGrid grid;
    for (int z = -radius; z <= radius; ++z)
        for (int y = -radius; y <= radius; ++y)
            for (int x = -radius; x <= radius; ++x) {
                const double r = glm::length(dvec3(x, y, z)) / radius;
                if (r < 1) grid.voxels.push_back({{x, y, z}, (1 - r) * (1.2 + std::sin(x * 0.9))});
            }
    return grid;
}

bool mentions(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

class Packings : public testing::TestWithParam<std::tuple<Packing, bool, std::string>> {};

TEST_P(Packings, LoadVolume_Blob_EqualsOpenVdbsSampler) {
    const auto& [packing, offsets, type] = GetParam();
    TempFolder folder;
    TestGrid blob = makeBlob();
    blob.type = type;
    blob.worldFromIndex =
        glm::scale(glm::translate(dmat4(1), dvec3(3, 2, 1)), dvec3(0.2, 0.3, 0.4));
    writeVdb(folder / "blob.vdb", {blob}, packing, offsets);
    const VolumeGrid grid = loadVolume(volumeOf(folder / "blob.vdb"), 1, Log{});
    const DensityField density(grid);
    RandomRays random(1, dvec3(-12), dvec3(12));
    if (type == "double") {
        for (const TestVoxel& voxel : blob.voxels)
            ASSERT_EQ(density.sample(dvec3(voxel.at)), static_cast<float>(voxel.value));
        return;
    }
    const VdbSampler sampler(folder / "blob.vdb", "density");
    for (int i = 0; i < 3000; ++i) {
        const dvec3 p = random.point();
        ASSERT_NEAR(density.sample(p), sampler.sample(p), 1e-6);
        ASSERT_LT(glm::length(transformPoint(grid.worldFromIndex, p) - sampler.world(p)), 1e-12);
    }
}

INSTANTIATE_TEST_SUITE_P(All, Packings,
                         testing::Combine(testing::Values(Packing::None, Packing::Mask,
                                                          Packing::ZipMask, Packing::BloscMask,
                                                          Packing::BloscOnly),
                                          testing::Bool(),
                                          testing::Values("float", "half", "double")));

TEST(LoadVolume_InactiveVoxelsAndTiles, CountAsZero) {
    TempFolder folder;
    TestGrid grid;
    grid.voxels = {{{1, 1, 1}, 1, true}, {{3, 3, 3}, 7, false}};
    grid.tiles = {
        {{16, 0, 0}, 1, 0.5, true}, {{32, 0, 0}, 1, 0.75, false}, {{4096, 0, 0}, 3, 9, false}};
    writeVdb(folder / "a.vdb", {grid});
    const VolumeGrid volume = loadVolume(volumeOf(folder / "a.vdb"), 1, Log{});
    EXPECT_EQ(sampleDensity(volume, {1, 1, 1}), 1);
    EXPECT_EQ(sampleDensity(volume, {3, 3, 3}), 0);
    EXPECT_EQ(sampleDensity(volume, {20, 4, 4}), 0.5);
    EXPECT_EQ(sampleDensity(volume, {36, 4, 4}), 0);
    EXPECT_EQ(sampleDensity(volume, {5000, 4, 4}), 0);
    ASSERT_EQ(volume.boxes.size(), 1u);
}

TEST(LoadVolume_FaultyValues, AreRepairedCountedAndWarnedOnce) {
    TempFolder folder;
    TestGrid grid;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    grid.voxels = {
        {{0, 0, 0}, nan}, {{1, 0, 0}, -1}, {{2, 0, 0}, -2}, {{3, 0, 0}, kInfinity}, {{4, 0, 0}, 1}};
    grid.background = 0.25;
    writeVdb(folder / "a.vdb", {grid});
    LogCatcher catcher;
    const VolumeGrid volume = loadVolume(volumeOf(folder / "a.vdb"), 1, catcher.log());
    EXPECT_EQ(volume.report.nan, 1u);
    EXPECT_EQ(volume.report.negative, 2u);
    EXPECT_EQ(volume.report.infinite, 1u);
    EXPECT_EQ(volume.report.cap, 65504.0f);
    EXPECT_TRUE(volume.report.clippedBackground);
    EXPECT_EQ(catcher.warnings.size(), 4u);
    const auto infos = listGrids(folder / "a.vdb");
    ASSERT_EQ(infos.size(), 1u);
    EXPECT_EQ(infos[0].sanitised.negative, 2u);
    EXPECT_EQ(infos[0].minValue, -2);
    EXPECT_EQ(infos[0].maxValue, 1) << "of the finite values";
    EXPECT_EQ(infos[0].background, 0.25);
}

TEST(LoadVolume_HalfOverflow, BecomesTheCapAndIsCounted) {
    TempFolder folder;
    TestGrid grid;
    grid.type = "half";
    grid.voxels = {{{0, 0, 0}, 1e6}, {{1, 0, 0}, 6e-8}};
    writeVdb(folder / "a.vdb", {grid});
    const VolumeGrid volume = loadVolume(volumeOf(folder / "a.vdb"), 1, Log{});
    EXPECT_EQ(volume.report.infinite, 1u);
    EXPECT_EQ(sampleDensity(volume, {0, 0, 0}), 65504);
    EXPECT_GT(sampleDensity(volume, {1, 0, 0}), 5e-8) << "half denormals stay";
}

TEST(LoadVolume_GridsOfOneName, AreChosenByIndex) {
    TempFolder folder;
    std::vector<TestGrid> grids(3);
    for (int i = 0; i < 3; ++i) grids[i].voxels = {{{0, 0, 0}, 1.0 + i}};
    writeVdb(folder / "a.vdb", grids);
    scene::Volume volume = volumeOf(folder / "a.vdb");
    const std::string error = inputErrorOf([&] { loadVolume(volume, 1, Log{}); });
    EXPECT_TRUE(mentions(error, "a.vdb") && mentions(error, "3 grids") &&
                mentions(error, "gridIndex"))
        << error;
    for (int i = 0; i < 3; ++i) {
        volume.gridIndex = i;
        EXPECT_EQ(sampleDensity(loadVolume(volume, 1, Log{}), dvec3(0)), 1 + i);
    }
    volume.gridIndex = 3;
    EXPECT_TRUE(mentions(inputErrorOf([&] { loadVolume(volume, 1, Log{}); }), "0 to 2"));
}

TEST(LoadVolume_MissingAndUnnamedGrids, ListWhatThereIs) {
    TempFolder folder;
    TestGrid grid = makeBlob(2);
    grid.name = "";
    TestGrid other;
    other.name = "heat";
    other.type = "half";
    writeVdb(folder / "a.vdb", {grid, other});
    const std::string error =
        inputErrorOf([&] { loadVolume(volumeOf(folder / "a.vdb"), 1, Log{}); });
    EXPECT_TRUE(mentions(error, "\"heat\"[0] (half)") && mentions(error, "\"\"[0] (float)"))
        << error;
    EXPECT_FALSE(loadVolume(volumeOf(folder / "a.vdb", ""), 1, Log{}).isEmpty());
}

TEST(LoadVolume_WhatIsNoDensity, IsRefusedWithTheReason) {
    TempFolder folder;
    for (const char* type :
         {"int32", "int64", "bool", "mask", "vec3s", "vec3half", "vec3d", "points"}) {
        TestGrid grid;
        grid.type = type;
        grid.gridClass = "unknown";
        grid.voxels = {{{1, 2, 3}, 1}};
        writeVdb(folder / "a.vdb", {grid});
        const std::string error =
            inputErrorOf([&] { loadVolume(volumeOf(folder / "a.vdb"), 1, Log{}); });
        EXPECT_TRUE(mentions(error, "\"density\"") && mentions(error, "type"))
            << type << ": " << error;
        const auto infos = listGrids(folder / "a.vdb");
        ASSERT_EQ(infos.size(), 1u);
        EXPECT_NE(infos[0].refusal, "");
        const std::string name = type;
        if (name == "points" || name == "int64" || name == "mask" || name == "vec3d") continue;
        EXPECT_EQ(infos[0].activeVoxels, 1u) << type;
        EXPECT_EQ(infos[0].lo, ivec3(1, 2, 3));
        EXPECT_EQ(infos[0].hi, ivec3(1, 2, 3));
    }
    TestGrid levelSet;
    levelSet.gridClass = "level set";
    levelSet.background = 3;
    levelSet.voxels = {{{0, 0, 0}, -1}};
    writeVdb(folder / "a.vdb", {levelSet});
    EXPECT_TRUE(mentions(inputErrorOf([&] { loadVolume(volumeOf(folder / "a.vdb"), 1, Log{}); }),
                         "level set"));
    TestGrid frustum = makeBlob(3);
    frustum.frustum = true;
    writeVdb(folder / "a.vdb", {frustum});
    EXPECT_TRUE(mentions(inputErrorOf([&] { loadVolume(volumeOf(folder / "a.vdb"), 1, Log{}); }),
                         "frustum"));
    EXPECT_EQ(listGrids(folder / "a.vdb")[0].transform, "frustum");
}

TEST(LoadVolume_PointsBesideDensity, LoadsTheDensity) {
    TempFolder folder;
    TestGrid points;
    points.type = "points";
    points.name = "points";
    writeVdb(folder / "a.vdb", {points, makeBlob(3)});
    EXPECT_FALSE(loadVolume(volumeOf(folder / "a.vdb"), 1, Log{}).isEmpty());
}

TEST(LoadVolume_Instance, ReadsTheSharedTree) {
    TempFolder folder;
    TestGrid second;
    second.name = "copy";
    second.instanceOf = "density";
    second.worldFromIndex = glm::scale(dmat4(1), dvec3(2));
    for (const bool offsets : {true}) {
        writeVdb(folder / "a.vdb", {makeBlob(3), second}, Packing::BloscMask, offsets);
        const VolumeGrid grid = loadVolume(volumeOf(folder / "a.vdb", "copy"), 1, Log{});
        EXPECT_GT(sampleDensity(grid, dvec3(0)), 0);
        EXPECT_EQ(grid.worldFromIndex[0][0], 2);
    }
}

TEST(LoadVolume_EmptyGrid, IsEmptyWithoutComplaint) {
    TempFolder folder;
    writeVdb(folder / "a.vdb", {TestGrid{}});
    LogCatcher catcher;
    EXPECT_TRUE(loadVolume(volumeOf(folder / "a.vdb"), 1, catcher.log()).isEmpty());
    EXPECT_TRUE(catcher.warnings.empty());
    const GridInfo info = listGrids(folder / "a.vdb").at(0);
    EXPECT_GT(info.lo.x, info.hi.x);
    EXPECT_EQ(info.activeVoxels, 0u);
}

TEST(LoadVolume_ShearRotationMirror, KeepTheAffineMap) {
    TempFolder folder;
    dmat4 m = glm::rotate(dmat4(1), 0.7, glm::normalize(dvec3(1, 2, 3)));
    m = glm::scale(m, dvec3(-0.5, 0.25, 2));
    m[1] += 0.3 * m[0];
    m[3] = dvec4(1e7, -3, 5, 1);
    TestGrid grid = makeBlob(3);
    grid.worldFromIndex = m;
    writeVdb(folder / "a.vdb", {grid});
    scene::Volume volume = volumeOf(folder / "a.vdb");
    volume.worldFromFile = glm::scale(glm::translate(dmat4(1), dvec3(0, 7, 0)), dvec3(3));
    const VolumeGrid loaded = loadVolume(volume, 1, Log{});
    const VdbSampler sampler(folder / "a.vdb", "density");
    for (const dvec3& p :
         {dvec3(0), dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1), dvec3(-3, 2, 1)}) {
        const dvec3 expected = transformPoint(volume.worldFromFile, sampler.world(p));
        EXPECT_LT(glm::length(transformPoint(loaded.worldFromIndex, p) - expected), 1e-8);
    }
    EXPECT_TRUE(mentions(listGrids(folder / "a.vdb")[0].transform, "mirrored"));
}

TEST(LoadVolume_Boxes, CarryTheirBound) {
    TempFolder folder;
    writeVdb(folder / "a.vdb", {makeBlob()});
    scene::Volume volume = volumeOf(folder / "a.vdb");
    volume.representation = scene::VolumeRepresentation::Boxes;
    const VolumeGrid grid = loadVolume(volume, 2, Log{});
    EXPECT_TRUE(grid.bricks.empty());
    EXPECT_FALSE(grid.boxes.empty());
    EXPECT_GT(grid.opticalDepthBound, 0);
}

class NanoTypes : public testing::TestWithParam<std::tuple<std::string, NanoPacking>> {};

TEST_P(NanoTypes, LoadVolume_Nvdb_EqualsTheVoxels) {
    const auto& [type, packing] = GetParam();
    TempFolder folder;
    TestGrid blob = makeBlob(6);
    blob.worldFromIndex[0] = dvec4(0.5, 0.1, 0, 0);
    blob.worldFromIndex[3] = dvec4(1, 2, 3, 1);
    blob.tiles = {{{128, 0, 0}, 2, 0.5}, {{16, 0, 0}, 1, 0.25}, {{-8192, 0, 0}, 3, 0.125}};
    writeNvdb(folder / "a.nvdb", blob, type, packing);
    const VolumeGrid grid = loadVolume(volumeOf(folder / "a.nvdb"), 1, Log{});
    const DensityField density(grid);
    const double allowed = type == "float" ? 1e-7 : 0.02;
    for (const TestVoxel& voxel : blob.voxels)
        ASSERT_NEAR(density.sample(dvec3(voxel.at)), voxel.value, allowed);
    EXPECT_EQ(density.sample({130, 100, 9}), 0.5);
    EXPECT_EQ(density.sample({20, 1, 1}), 0.25);
    EXPECT_EQ(density.sample({-5000, 1, 1}), 0.125);
    EXPECT_LT(glm::length(transformPoint(grid.worldFromIndex, dvec3(1)) - dvec3(1.5, 3.1, 4)),
              1e-12);
    const GridInfo info = listGrids(folder / "a.nvdb").at(0);
    EXPECT_EQ(info.activeVoxels, blob.voxels.size() + 512 + (1u << 21) + (1ull << 36));
    EXPECT_EQ(info.activeTileCount, 3u);
    EXPECT_EQ(info.lo, ivec3(-8192, -5, -5));
    EXPECT_EQ(info.gridClass, "fog volume");
}

INSTANTIATE_TEST_SUITE_P(All, NanoTypes,
                         testing::Combine(testing::Values("float", "fp8", "fpN"),
                                          testing::Values(NanoPacking::None, NanoPacking::Zip,
                                                          NanoPacking::Blosc)));

TEST(LoadVolume_NvdbOfVectors, IsRefused) {
    TempFolder folder;
    TestGrid grid;
    grid.voxels = {{{1, 2, 3}, 1}};
    writeNvdb(folder / "a.nvdb", grid, "float", NanoPacking::None);
    // Turn both type fields from float (1) to vec3f (6): after the file's head and in the grid's
    // own.
    constexpr std::streamoff kTypeInHead = 16 + 32, kNameSize = 16 + 136, kTypeInGrid = 636;
    std::fstream file(folder / "a.nvdb", std::ios::in | std::ios::out | std::ios::binary);
    std::uint32_t nameSize = 0;
    file.seekg(kNameSize);
    file.read(reinterpret_cast<char*>(&nameSize), sizeof(nameSize));
    for (const std::streamoff at : {kTypeInHead, 16 + 176 + nameSize + kTypeInGrid}) {
        file.seekp(at);
        file.put(6);
    }
    file.close();
    EXPECT_TRUE(mentions(inputErrorOf([&] { loadVolume(volumeOf(folder / "a.nvdb"), 1, Log{}); }),
                         "vec3s"));
    EXPECT_EQ(listGrids(folder / "a.nvdb").at(0).activeVoxels, 1u);
}

TEST(LoadVolume_BrokenFiles, GiveOneLine) {
    TempFolder folder;
    const auto check = [&](const std::string& name, const std::string& bytes) {
        std::ofstream(folder / name, std::ios::binary) << bytes;
        const std::string a = inputErrorOf([&] { loadVolume(volumeOf(folder / name), 1, Log{}); });
        const std::string b = inputErrorOf([&] { listGrids(folder / name); });
        EXPECT_TRUE(mentions(a, name)) << a;
        EXPECT_TRUE(mentions(b, name)) << b;
    };
    check("empty.vdb", "");
    check("short.vdb", "abc");
    check("text.vdb", "this is not a volume at all");
    check("short.nvdb", "NanoVDB0");
    check("text.nvdb", "neither is this one");
    EXPECT_TRUE(mentions(inputErrorOf([&] { listGrids(folder / "missing.vdb"); }), "missing.vdb"));
    EXPECT_NE(inputErrorOf([&] { listGrids(std::filesystem::temp_directory_path()); }), "");
}

}  // namespace
}  // namespace brume::volumes::test
