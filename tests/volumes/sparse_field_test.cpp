// SPDX-License-Identifier: Apache-2.0
// From voxels and tiles to bricks and boxes.
#include <volumes/support.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

namespace brume::volumes::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

TEST(BuildVolume_Nothing, IsEmpty) {
    const VolumeGrid grid = buildVolume({}, "none", dmat4(1));
    EXPECT_TRUE(grid.isEmpty());
    EXPECT_TRUE(grid.worldBounds().isEmpty());
    EXPECT_EQ(DensityField(grid).sample({0, 0, 0}), 0);
    EXPECT_EQ(DensityField(grid).opticalDepth({{-9, 0, 0}, {1, 0, 0}}, 0, 100), 0);
}

TEST(BuildVolume_OneVoxelInTheCorner, MakesBricksOnAllSidesThatItReaches) {
    for (const auto& [at, bricks] : {std::pair(ivec3(0), 8u), std::pair(ivec3(3, 4, 5), 1u),
                                     std::pair(ivec3(0, 4, 0), 4u), std::pair(ivec3(7), 1u)}) {
        SparseField field;
        setVoxel(field, at, 2);
        const VolumeGrid grid = buildVolume(field, "one", dmat4(1));
        EXPECT_EQ(grid.bricks.size(), bricks);
        const Box3 bounds = grid.indexBounds();
        EXPECT_EQ(bounds.lo, dvec3(at) - 1.0);
        EXPECT_EQ(bounds.hi, dvec3(at) + 1.0);
    }
}

TEST(BuildVolume_Noise, HoldsEveryCellWithDensityInExactlyOneBrick) {
    const SparseField field = makeNoise(1, 13);
    const VolumeGrid grid = buildVolume(field, "noise", dmat4(1));
    std::map<std::tuple<int, int, int>, int> bricks;
    for (const Brick& brick : grid.bricks) {
        EXPECT_EQ(brick.origin & 7, ivec3(0));
        EXPECT_GT(brick.maxValue, 0);
        const float* values = grid.values.data() + brick.valueOffset;
        EXPECT_EQ(brick.maxValue, *std::max_element(values, values + kBrickValueCount));
        ++bricks[{brick.origin.x, brick.origin.y, brick.origin.z}];
        for (int k = 0; k < kBrickValues; ++k)
            for (int j = 0; j < kBrickValues; ++j)
                for (int i = 0; i < kBrickValues; ++i)
                    ASSERT_EQ(*values++, voxelAt(field, brick.origin + ivec3(i, j, k)));
    }
    for (const auto& [origin, count] : bricks) EXPECT_EQ(count, 1);
    for (int z = -15; z <= 15; ++z)
        for (int y = -15; y <= 15; ++y)
            for (int x = -15; x <= 15; ++x) {
                bool zero = true;
                for (int c = 0; c < 8; ++c)
                    zero = zero &&
                           voxelAt(field, ivec3(x, y, z) + ivec3(c & 1, (c >> 1) & 1, c >> 2)) == 0;
                if (zero) continue;
                ASSERT_EQ(bricks.count({x & ~7, y & ~7, z & ~7}), 1u);
            }
}

TEST(Sanitise_FaultyValues, RepairsAndCountsThem) {
    SparseField field;
    const float faults[] = {kNan, -kNan, -1, -kInf, kInf, 2e30f, -0.0f, 1e-42f, 3};
    for (int i = 0; i < 9; ++i) setVoxel(field, {i % 8, i / 8, 1}, faults[i]);
    field.tiles = {{{8, 0, 0}, 8, kNan}, {{16, 0, 0}, 8, -2}, {{128, 0, 0}, 128, kInf}};
    const SanitiseReport report = sanitise(field);
    EXPECT_EQ(report.nan, 2u + 512u);
    EXPECT_EQ(report.negative, 2u + 512u);
    EXPECT_EQ(report.infinite, 2u + (1u << 21));
    EXPECT_EQ(report.cap, 65504.0f);
    EXPECT_FALSE(report.clippedBackground);
    EXPECT_FALSE(std::signbit(voxelAt(field, {6, 0, 1})));
    EXPECT_EQ(voxelAt(field, {7, 0, 1}), 1e-42f) << "denormal values stay";
    EXPECT_EQ(voxelAt(field, {4, 0, 1}), 65504.0f);
    const VolumeGrid grid = buildVolume(field, "faults", dmat4(1));
    EXPECT_TRUE(std::all_of(grid.values.begin(), grid.values.end(),
                            [](float v) { return v >= 0 && v <= 65504.0f; }));
    ASSERT_EQ(grid.boxes.size(), 1u) << "tiles of zeros are left out";
    EXPECT_EQ(grid.boxes[0].value, 65504.0f);
}

TEST(Sanitise_BackgroundOfOne, IsReportedAndTakenAsZero) {
    SparseField field;
    field.background = 1;
    setVoxel(field, {1, 1, 1}, 1);
    const VolumeGrid grid = buildVolume(field, "background", dmat4(1));
    EXPECT_TRUE(grid.report.clippedBackground);
    EXPECT_EQ(sampleDensity(grid, {50, 0, 0}), 0);
}

TEST(BuildVolume_Tiles, BecomeSoftBoxesWithoutBricks) {
    SparseField field;
    field.tiles = {{{0, 0, 0}, 8, 0.5f}, {{128, 0, 0}, 128, 0.25f}, {{4096, 0, 0}, 4096, 1e-4f}};
    const VolumeGrid grid = buildVolume(field, "tiles", dmat4(1));
    EXPECT_TRUE(grid.bricks.empty());
    EXPECT_TRUE(grid.values.empty());
    ASSERT_EQ(grid.boxes.size(), 3u);
    const DensityField density(grid);
    EXPECT_EQ(density.sample({3, 3, 3}), 0.5);
    EXPECT_EQ(density.sample({7.5, 3, 3}), 0.25);
    EXPECT_EQ(density.sample({7.5, 7.5, 7.5}), 0.0625);
    EXPECT_EQ(density.sample({8, 3, 3}), 0);
    EXPECT_EQ(density.sample({200, 60, 127.75}), 0.0625);
    EXPECT_FLOAT_EQ(static_cast<float>(density.sample({6000, 1, 4095})), 1e-4f);
    // 0.5 over 8 voxels with two half ramps, 0.25 over 128, 1e-4 over 4096.
    const double depth = density.opticalDepth({{-10, 4, 4}, {1, 0, 0}}, 0, 10000);
    EXPECT_NEAR(depth, 0.5 * 8 + 0.25 * 128 + static_cast<double>(1e-4f) * 4096, 1e-12);
}

TEST(BuildVolume_NeighbouringTilesOfOneValue, AreOneBox) {
    SparseField field;
    for (int z = 0; z < 4; ++z)
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 5; ++x) field.tiles.push_back({8 * ivec3(x, y, z), 8, 0.5f});
    field.tiles.push_back({{40, 0, 0}, 8, 0.25f});
    const VolumeGrid grid = buildVolume(field, "tiles", dmat4(1));
    ASSERT_EQ(grid.boxes.size(), 2u);
    const DensityField density(grid);
    EXPECT_EQ(density.sample({16, 8, 23.5}), 0.5);
    EXPECT_EQ(density.sample({39.5, 4, 4}), 0.375) << "ramps of neighbours add up";
}

TEST(BuildVolume_TileBesideVoxels, AddsUpToTheInterpolant) {
    // The same field once with a tile and once with voxels in its place.
    SparseField voxels = makeNoise(3, 4), withTile;
    for (const VoxelBlock& block : voxels.blocks) withTile.blocks.push_back(block);
    withTile.tiles.push_back({{8, 0, 0}, 8, 0.75f});
    for (int i = 0; i < 512; ++i) setVoxel(voxels, {8 + (i >> 6), (i >> 3) & 7, i & 7}, 0.75f);
    const VolumeGrid a = buildVolume(voxels, "voxels", dmat4(1));
    const VolumeGrid b = buildVolume(withTile, "tile", dmat4(1));
    const DensityField fieldA(a), fieldB(b);
    RandomRays random(4, dvec3(-6), dvec3(18));
    for (int i = 0; i < 2000; ++i) {
        const dvec3 p = random.point();
        ASSERT_NEAR(fieldA.sample(p), fieldB.sample(p), 1e-12);
        const IndexRay ray = random.next();
        ASSERT_NEAR(fieldA.opticalDepth(ray, 0, 1), fieldB.opticalDepth(ray, 0, 1), 1e-12);
    }
}

TEST(BuildVolume_TwoVoxelsFarApart, TakesAFewBricks) {
    SparseField field;
    setVoxel(field, ivec3(-1000000), 1);
    setVoxel(field, ivec3(1000000), 1);
    const VolumeGrid grid = buildVolume(field, "far", dmat4(1));
    EXPECT_LE(grid.bricks.size(), 16u);
    const DensityField density(grid);
    EXPECT_EQ(density.sample(dvec3(1000000)), 1);
    EXPECT_EQ(density.sample(dvec3(0)), 0);
    EXPECT_NEAR(density.opticalDepth({dvec3(-2e6), dvec3(1)}, 0, 4e6), 2 * 0.5, 1e-6);
}

TEST(BuildVolume_WhatCannotBe, IsRefusedByName) {
    SparseField field;
    setVoxel(field, {1, 1, 1}, 1);
    dmat4 singular(1);
    singular[2] = dvec4(0);
    EXPECT_NE(inputErrorOf([&] { buildVolume(field, "flat", singular); }).find("flat"),
              std::string::npos);
    dmat4 infinite(1);
    infinite[3][0] = kInfinity;
    EXPECT_NE(inputErrorOf([&] { buildVolume(field, "gone", infinite); }), "");
    SparseField outside;
    setVoxel(outside, {std::numeric_limits<int>::min(), 0, 0}, 1);
    EXPECT_NE(inputErrorOf([&] { buildVolume(outside, "outside", dmat4(1)); }), "");
}

TEST(WorldBounds_ShearAndMirror, ContainTheTransformedVoxels) {
    dmat4 m(1);
    m[0] = dvec4(-2, 0, 0, 0);
    m[1] = dvec4(0.5, 1, 0, 0);
    m[3] = dvec4(10, 20, 30, 1);
    SparseField field;
    setVoxel(field, {1, 2, 3}, 1);
    const VolumeGrid grid = buildVolume(field, "sheared", m);
    const Box3 bounds = grid.worldBounds();
    EXPECT_EQ(bounds.lo, dvec3(10 - 4 + 0.5, 21, 32));
    EXPECT_EQ(bounds.hi, dvec3(10 - 0 + 1.5, 23, 34));
}

}  // namespace
}  // namespace brume::volumes::test
