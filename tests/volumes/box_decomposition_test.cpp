// SPDX-License-Identifier: Apache-2.0
// Homogeneous boxes against the exact interpolant.
#include <volumes/box_decomposition.hpp>
#include <volumes/support.hpp>

#include <algorithm>

namespace brume::volumes::test {
namespace {

/// A field as smooth as smoke.
SparseField makeBlob(int radius) {
    SparseField field;
    for (int z = -radius; z <= radius; ++z)
        for (int y = -radius; y <= radius; ++y)
            for (int x = -radius; x <= radius; ++x) {
                const double r = glm::length(dvec3(x, y, z)) / radius;
                const double wave = 0.6 + 0.4 * std::sin(0.7 * x) * std::cos(0.5 * y + 0.3 * z);
                if (r < 1) setVoxel(field, {x, y, z}, static_cast<float>((1 - r * r) * wave));
            }
    return field;
}

/// Integral of a grid's density over index space.
double massOf(const VolumeGrid& grid) {
    double mass = 0;
    for (const Brick& brick : grid.bricks)
        for (int k = 0; k < kBrickValues; ++k)
            for (int j = 0; j < kBrickValues; ++j)
                for (int i = 0; i < kBrickValues; ++i) {
                    const auto weight = [](int n) { return n % kBrickCells == 0 ? 0.5 : 1.0; };
                    mass +=
                        weight(i) * weight(j) * weight(k) *
                        static_cast<double>(grid.values[brick.valueOffset +
                                                        (k * kBrickValues + j) * kBrickValues + i]);
                }
    for (const ValueBox& box : grid.boxes) {
        const dvec3 size = box.hi - box.lo + (box.soft ? 1.0 : 0.0);
        mass += static_cast<double>(box.value) * size.x * size.y * size.z;
    }
    return mass;
}

class Tolerances : public testing::TestWithParam<double> {};

TEST_P(Tolerances, ConvertToBoxes_Blob_KeepsMassAndStaysWithinItsBound) {
    dmat4 m = glm::scale(dmat4(1), dvec3(0.1, 0.15, 0.1));
    m[1][0] = 0.03;
    const VolumeGrid exact = buildVolume(makeBlob(14), "blob", m);
    VolumeGrid boxes = exact;
    constexpr double kExtinction = 3;
    convertToBoxes(boxes, kExtinction, GetParam());
    EXPECT_TRUE(boxes.bricks.empty() && boxes.values.empty());
    EXPECT_NEAR(massOf(boxes), massOf(exact), 1e-5 * massOf(exact));
    const DensityField a(exact), b(boxes);
    const dmat4 indexFromWorld = glm::inverse(m);
    RandomRays random(8, exact.worldBounds().lo, exact.worldBounds().hi);
    double worst = 0;
    for (int i = 0; i < 300; ++i) {
        const dvec3 from = random.point(), to = random.point();
        const double length = glm::length(to - from);
        const IndexRay ray{transformPoint(indexFromWorld, from),
                           transformVector(indexFromWorld, (to - from) / length)};
        worst = std::max(worst,
                         std::abs(a.opticalDepth(ray, 0, length) - b.opticalDepth(ray, 0, length)));
    }
    EXPECT_GT(worst, 0);
    EXPECT_LE(worst, boxes.opticalDepthBound);
    EXPECT_LT(boxes.opticalDepthBound, kInfinity);
}

INSTANTIATE_TEST_SUITE_P(All, Tolerances, testing::Values(0.0, 0.01, 0.1, 1.0, 100.0));

TEST(ConvertToBoxes_ZeroTolerance, MakesOneBoxPerCell) {
    SparseField field;
    setVoxel(field, {2, 3, 4}, 1);
    VolumeGrid grid = buildVolume(field, "voxel", dmat4(1));
    convertToBoxes(grid, 1, 0);
    ASSERT_EQ(grid.boxes.size(), 8u);
    for (const ValueBox& box : grid.boxes) {
        EXPECT_EQ(box.hi - box.lo, dvec3(1));
        EXPECT_EQ(box.value, 0.125f);
        EXPECT_FALSE(box.soft);
    }
    // A ray through a cell misses its mean by at most 0.875 over at most sqrt(3), in each of the
    // two slabs.
    EXPECT_NEAR(grid.opticalDepthBound, 2 * 0.875 * std::sqrt(3.0), 1e-12);
}

TEST(ConvertToBoxes_Tiles, StaySoftAndExact) {
    SparseField field;
    field.tiles.push_back({{0, 0, 0}, 4096, 0.5f});
    setVoxel(field, {-8, 0, 0}, 1);
    VolumeGrid grid = buildVolume(field, "tile", dmat4(1));
    convertToBoxes(grid, 1, 0.03);
    EXPECT_EQ(std::count_if(grid.boxes.begin(), grid.boxes.end(),
                            [](const ValueBox& b) { return b.soft; }),
              1);
}

TEST(ConvertToBoxes_FarApart, TakesFewBoxes) {
    SparseField field;
    setVoxel(field, ivec3(-1000000), 1);
    setVoxel(field, ivec3(1000000), 1);
    VolumeGrid grid = buildVolume(field, "far", dmat4(1));
    convertToBoxes(grid, 1, 0.03);
    EXPECT_EQ(grid.boxes.size(), 16u);
}

struct Comparison {
    std::size_t boxes = 0;
    double rms = 0, greatest = 0, segments = 0;
};

/// Transmittance through boxes against the exact one along parallel tilted rays, the medium scaled
/// to a greatest optical depth of 5.
Comparison compare(const VolumeGrid& exact, double tolerance) {
    constexpr int kRays = 128;
    const DensityField a(exact);
    const Box3 bounds = exact.indexBounds();
    const dvec3 direction = glm::normalize(dvec3(0.2, 0.1, 1));
    std::vector<IndexRay> rays;
    for (int j = 0; j < kRays; ++j)
        for (int i = 0; i < kRays; ++i) {
            const dvec3 p =
                bounds.lo + bounds.size() * dvec3((i + 0.5) / kRays, (j + 0.5) / kRays, 0.5);
            rays.push_back({p - 300.0 * direction, direction});
        }
    std::vector<double> depths;
    for (const IndexRay& ray : rays) depths.push_back(a.opticalDepth(ray, 0, 600));
    const double extinction = 5 / *std::max_element(depths.begin(), depths.end());
    VolumeGrid boxes = exact;
    convertToBoxes(boxes, extinction, tolerance);
    const DensityField b(boxes);
    Comparison result;
    result.boxes = boxes.boxes.size();
    std::size_t hit = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        double depth = 0;
        int segments = 0;
        b.visitRay(rays[i], 0, 600, [&](const DensitySegment& s) {
            depth += s.opticalDepth();
            ++segments;
        });
        EXPECT_LE(std::abs(depth - depths[i]), boxes.opticalDepthBound);
        const double error = std::exp(-extinction * depth) - std::exp(-extinction * depths[i]);
        result.rms += error * error;
        result.greatest = std::max(result.greatest, std::abs(error));
        result.segments += segments;
        hit += segments > 0;
    }
    result.rms = std::sqrt(result.rms / static_cast<double>(rays.size()));
    result.segments /= static_cast<double>(hit);
    return result;
}

TEST(ConvertToBoxes_Smoke1, MatchesThePublishedTable) {
    BRUME_SHARED_FILE(file, "vdb/openvdb_smoke1.vdb");
    VolumeGrid grid = loadVolume(volumeOf(file), 1, Log{});
    grid.worldFromIndex = dmat4(1);  // the table is in voxels
    struct Row {
        double tolerance, boxes, rms;
    };
    for (const Row& row :
         {Row{0.01, 289944, 6.0e-3}, Row{0.1, 51091, 1.6e-2}, Row{0.3, 10229, 2.9e-2}}) {
        const Comparison found = compare(grid, row.tolerance);
        RecordProperty("boxes", static_cast<int>(found.boxes));
        printf("tolerance %g: %zu boxes, %.1f segments, rms %.2e, max %.2e\n", row.tolerance,
               found.boxes, found.segments, found.rms, found.greatest);
        EXPECT_NEAR(static_cast<double>(found.boxes), row.boxes, 0.25 * row.boxes);
        EXPECT_NEAR(found.rms, row.rms, 0.5 * row.rms);
    }
}

}  // namespace
}  // namespace brume::volumes::test
