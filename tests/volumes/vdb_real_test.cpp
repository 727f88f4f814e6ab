// SPDX-License-Identifier: Apache-2.0
// Files of other programs, and hostile ones, against what they are known to hold.
#include <volumes/allocation_watch.hpp>
#include <volumes/support.hpp>
#include <volumes/vdb_writer.hpp>

namespace brume::volumes::test {
namespace {

constexpr std::size_t kGiB = 1ull << 30;

struct Known {
    const char* file;
    const char* grid;
    int index;
    ivec3 lo, hi;
    std::uint64_t voxels;
};

/// Its name in lists of tests, the same in every run.
void PrintTo(const Known& known, std::ostream* out) {
    *out << known.file << ' ' << known.grid << ' ' << known.index;
}

class KnownFiles : public testing::TestWithParam<Known> {};

TEST_P(KnownFiles, ListGrids_CountsAndBoxes_AreRight) {
    const Known& known = GetParam();
    BRUME_SHARED_FILE(file, known.file);
    bool found = false;
    for (const GridInfo& info : listGrids(file)) {
        if (info.name != known.grid || info.index != known.index) continue;
        found = true;
        EXPECT_EQ(info.activeVoxels, known.voxels);
        EXPECT_EQ(info.refusal, "");
        if (known.voxels == 0) {
            EXPECT_GT(info.lo.x, info.hi.x);
        } else {
            EXPECT_EQ(info.lo, known.lo);
            EXPECT_EQ(info.hi, known.hi);
        }
    }
    EXPECT_TRUE(found);
}

TEST_P(KnownFiles, LoadVolume_Samples_EqualOpenVdbs) {
    const Known& known = GetParam();
    BRUME_SHARED_FILE(file, known.file);
    scene::Volume volume = volumeOf(file, known.grid);
    volume.gridIndex = known.index;
    const VolumeGrid grid = loadVolume(volume, 1, Log{});
    const DensityField density(grid);
    EXPECT_EQ(grid.isEmpty(), known.voxels == 0);
    if (grid.isEmpty() || file.extension() == ".nvdb") return;
    const std::string name = std::string(known.grid) + "[" + std::to_string(known.index) + "]";
    const bool several = std::string(known.file).find("arnold") != std::string::npos;
    const VdbSampler sampler(file, several ? name : known.grid);
    RandomRays random(1, dvec3(known.lo) - 2.0, dvec3(known.hi) + 2.0);
    int compared = 0;
    for (int i = 0; i < 20000; ++i) {
        const dvec3 p = random.point();
        bool comparable = true;
        double local = 0;  // the sampler of OpenVDB interpolates in float
        for (int c = 0; c < 8; ++c) {
            const ivec3 corner = ivec3(glm::floor(p)) + ivec3(c & 1, (c >> 1) & 1, c >> 2);
            comparable = comparable && sampler.isActiveOrZero(corner);
            local = std::max(local, density.sample(dvec3(corner)));
        }
        if (!comparable) continue;
        ++compared;
        const double expected = std::max(0.0, sampler.sample(p));
        ASSERT_NEAR(density.sample(p), expected, 1e-6 * (1 + local));
    }
    EXPECT_GT(compared, 10000);
    const dvec3 corner(known.lo);
    EXPECT_LT(glm::length(transformPoint(grid.worldFromIndex, corner) - sampler.world(corner)),
              1e-9 * (1 + glm::length(sampler.world(corner))));
}

INSTANTIATE_TEST_SUITE_P(
    All, KnownFiles,
    testing::Values(
        Known{"vdb/openvdb_smoke1.vdb", "density", 0, {1, 2, 1}, {111, 223, 112}, 1049275},
        Known{"vdb/usd_smoke_000001.vdb", "density", 0, {}, {}, 0},
        Known{"vdb/usd_smoke_000002.vdb", "density", 0, {1, 1, 11}, {51, 49, 90}, 71983},
        Known{"vdb/usd_smoke_000003.vdb", "density", 0, {1, 1, 3}, {51, 49, 98}, 90197},
        Known{"vdb/usd_densityAndHeat.vdb", "density", 0, {1, 1, 31}, {23, 23, 72}, 6124},
        Known{"vdb/usd_densityAndHeat.vdb", "heat", 0, {2, 2, 31}, {23, 22, 62}, 5224},
        Known{"vdb/arnold_grids.vdb", "density", 0, ivec3(-5), ivec3(5), 491},
        Known{"vdb/arnold_grids.vdb", "density", 1, {-9, -13, -9}, {9, 5, 12}, 2222},
        Known{"vdb/arnold_grids.vdb", "density", 2, ivec3(-5), ivec3(5), 803},
        Known{"vdb/oiio_sphere.vdb", "density", 0, ivec3(-12), ivec3(12), 9047},
        Known{
            "nvdb/pbrt_teapot_cloud.nvdb", "density", 0, {-136, -60, -90}, {130, 73, 87}, 1963736},
        Known{"blender/fire16/fluid_data_0030.vdb", "density", 0, ivec3(1), {30, 30, 46}, 34954},
        Known{"blender/fire16/fluid_data_0030.vdb", "flame", 0, ivec3(1), {29, 30, 30}, 9962},
        Known{"hard/empty.vdb", "density", 0, {}, {}, 0},
        Known{"hard/far_origin.vdb", "density", 0, ivec3(-9), ivec3(9), 4139},
        Known{"hard/shear.vdb", "density", 0, ivec3(-9), ivec3(9), 4139},
        Known{"hard/tiny_voxels.vdb", "density", 0, ivec3(-9), ivec3(9), 4139},
        Known{"hard/dynamic_range_1e12.vdb", "density", 0, ivec3(-9), ivec3(9), 4139},
        Known{"hard/multires_fields.vdb", "temperature", 0, ivec3(-4), ivec3(4), 485}));

TEST(TeapotCloud, KeepsItsLargestValueAndNegativeIndices) {
    BRUME_SHARED_FILE(file, "nvdb/pbrt_teapot_cloud.nvdb");
    const GridInfo info = listGrids(file).at(0);
    EXPECT_EQ(info.hi - info.lo + 1, ivec3(267, 134, 178));
    EXPECT_EQ(info.maxValue, 50);
    const VolumeGrid grid = loadVolume(volumeOf(file), 1, Log{});
    float greatest = 0;
    for (const Brick& brick : grid.bricks) greatest = std::max(greatest, brick.maxValue);
    for (const ValueBox& box : grid.boxes) greatest = std::max(greatest, box.value);
    EXPECT_EQ(greatest, 50);
}

TEST(BlendersShadowGrid, IsNegativeAndSoEmpty) {
    BRUME_SHARED_FILE(file, "blender/fire16/fluid_data_0030.vdb");
    LogCatcher catcher;
    const VolumeGrid grid = loadVolume(volumeOf(file, "shadow"), 1, catcher.log());
    EXPECT_TRUE(grid.isEmpty());
    EXPECT_EQ(grid.report.negative, 65536u);
    EXPECT_EQ(catcher.warnings.size(), 1u);
    for (const GridInfo& info : listGrids(file)) {
        if (info.name != "velocity") continue;
        EXPECT_EQ(info.gridClass, "staggered");
        EXPECT_NE(info.refusal, "");
    }
}

TEST(ArnoldGrids, WithoutIndex_AreAmbiguous) {
    BRUME_SHARED_FILE(file, "vdb/arnold_grids.vdb");
    EXPECT_NE(inputErrorOf([&] { loadVolume(volumeOf(file), 1, Log{}); }).find("gridIndex"),
              std::string::npos);
}

TEST(HardFiles, UnreadableOnes_GiveOneLine) {
    BRUME_SHARED_FILE(folder, "hard");
    for (const char* name : {"bad_magic.vdb", "truncated.vdb", "zero_length.vdb", "frustum.vdb"}) {
        const auto file = folder / name;
        const std::string error = inputErrorOf([&] { loadVolume(volumeOf(file), 1, Log{}); });
        EXPECT_NE(error.find(name), std::string::npos) << error;
    }
}

TEST(HardFiles, FaultyVoxels_AreRepaired) {
    BRUME_SHARED_FILE(folder, "hard");
    const VolumeGrid faulty = loadVolume(volumeOf(folder / "nan_inf_negative.vdb"), 1, Log{});
    EXPECT_EQ(faulty.report.nan, 1u);
    EXPECT_EQ(faulty.report.negative, 2u);
    EXPECT_EQ(faulty.report.infinite, 2u) << "infinity and 3e38";
    for (const float value : faulty.values) ASSERT_TRUE(value >= 0 && value <= kValueCap);
    const VolumeGrid half = loadVolume(volumeOf(folder / "half_overflow.vdb"), 1, Log{});
    EXPECT_EQ(half.report.infinite, 2325u);
}

TEST(HardFiles, OtherTypes_AreConvertedOrRefused) {
    BRUME_SHARED_FILE(file, "hard/other_types.vdb");
    const VolumeGrid grid = loadVolume(volumeOf(file), 1, Log{});
    EXPECT_FLOAT_EQ(static_cast<float>(sampleDensity(grid, {7, 0, 0})), 1e-20f);
    for (const char* name : {"obstacles", "mask", "surface"})
        EXPECT_NE(inputErrorOf([&] { loadVolume(volumeOf(file, name), 1, Log{}); }).find(name),
                  std::string::npos);
}

TEST(HardFiles, TilesAndFarVoxels_StaySparse) {
    BRUME_SHARED_FILE(folder, "hard");
    resetLargestAllocation();
    const VolumeGrid tiles = loadVolume(volumeOf(folder / "tiles.vdb"), 1, Log{});
    EXPECT_EQ(listGrids(folder / "tiles.vdb").at(0).activeVoxels, 68721574400u);
    EXPECT_EQ(tiles.boxes.size(), 3u);
    EXPECT_TRUE(tiles.bricks.empty());
    const VolumeGrid far = loadVolume(volumeOf(folder / "two_voxels_far_apart.vdb"), 1, Log{});
    EXPECT_LE(far.bricks.size(), 16u);
    EXPECT_EQ(sampleDensity(far, dvec3(1000000)), 1);
    EXPECT_LT(largestAllocation(), 16u << 20);
}

TEST(HardFiles, AnyOfThem_StaysBelowOneGiB) {
    BRUME_SHARED_FILE(folder, "hard");
    resetLargestAllocation();
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        try {
            for (const GridInfo& info : listGrids(entry.path())) {
                scene::Volume volume = volumeOf(entry.path(), info.name);
                volume.gridIndex = info.index;
                for (const auto representation :
                     {scene::VolumeRepresentation::Bricks, scene::VolumeRepresentation::Boxes}) {
                    volume.representation = representation;
                    if (info.refusal.empty()) loadVolume(volume, 1, Log{});
                }
            }
        } catch (const Error& e) {
            EXPECT_EQ(e.kind(), ErrorKind::Input);
        }
    }
    EXPECT_LT(largestAllocation(), kGiB);
}

}  // namespace
}  // namespace brume::volumes::test
