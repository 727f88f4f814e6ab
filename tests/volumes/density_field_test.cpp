// SPDX-License-Identifier: Apache-2.0
// Exact samples and rays against their definitions.
#include <volumes/support.hpp>

namespace brume::volumes::test {
namespace {

/// Midpoint rule with many steps.
double quadrature(const DensityField& field, const IndexRay& ray, int steps) {
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        sum += field.sample(ray.origin + (i + 0.5) / steps * ray.direction);
    return sum / steps;
}

class Noise : public testing::Test {
  protected:
    Noise()
        : mField(makeNoise(7, 11)),
          mGrid(buildVolume(mField, "noise", dmat4(1))),
          mDensity(mGrid) {}

    SparseField mField;
    VolumeGrid mGrid;
    DensityField mDensity;
};

TEST_F(Noise, Sample_RandomPoints_EqualsTheInterpolant) {
    RandomRays random(1, dvec3(-14), dvec3(14));
    for (int i = 0; i < 20000; ++i) {
        const dvec3 p = random.point();
        ASSERT_NEAR(mDensity.sample(p), interpolate(mField, p), 1e-14);
    }
}

TEST_F(Noise, Sample_IntegerPoints_EqualsTheVoxels) {
    for (int z = -13; z <= 13; ++z)
        for (int y = -13; y <= 13; ++y)
            for (int x = -13; x <= 13; ++x)
                ASSERT_EQ(mDensity.sample(dvec3(x, y, z)), voxelAt(mField, {x, y, z}));
}

TEST_F(Noise, OpticalDepth_RandomRays_EqualsFineQuadrature) {
    RandomRays random(2, dvec3(-16), dvec3(16));
    for (int i = 0; i < 100; ++i) {
        const IndexRay ray = random.next();
        ASSERT_NEAR(mDensity.opticalDepth(ray, 0, 1), quadrature(mDensity, ray, 20000), 2e-6);
    }
}

TEST_F(Noise, OpticalDepth_SimpsonPerCell_IsTheSame) {
    RandomRays random(3, dvec3(-16), dvec3(16));
    for (int i = 0; i < 500; ++i) {
        const IndexRay ray = random.next();
        double simpson = 0;
        mDensity.visitRay(ray, 0, 1, [&](const DensitySegment& s) {
            const auto at = [&](double t) {
                return mDensity.sample(ray.origin + t * ray.direction);
            };
            simpson += (s.t1 - s.t0) / 6 * (at(s.t0) + 4 * at(0.5 * (s.t0 + s.t1)) + at(s.t1));
        });
        ASSERT_NEAR(mDensity.opticalDepth(ray, 0, 1), simpson, 1e-13);
    }
}

TEST_F(Noise, VisitRay_Segments_ReproduceTheDensity) {
    RandomRays random(4, dvec3(-16), dvec3(16));
    for (int i = 0; i < 200; ++i) {
        const IndexRay ray = random.next();
        mDensity.visitRay(ray, 0, 1, [&](const DensitySegment& s) {
            for (const double u : {0.0, 0.2, 0.5, 0.9, 1.0}) {
                const dvec3 p = ray.origin + (s.t0 + u * (s.t1 - s.t0)) * ray.direction;
                ASSERT_NEAR(s.density(u), interpolate(mField, p), 1e-12);
            }
        });
    }
}

TEST_F(Noise, OpticalDepth_SplitAnywhere_StaysTheSame) {
    RandomRays random(5, dvec3(-16), dvec3(16));
    for (int i = 0; i < 500; ++i) {
        const IndexRay ray = random.next();
        const double whole = mDensity.opticalDepth(ray, 0, 1);
        const double split =
            mDensity.opticalDepth(ray, 0, 0.37) + mDensity.opticalDepth(ray, 0.37, 1);
        ASSERT_NEAR(whole, split, 1e-13);
        const IndexRay back{ray.origin + ray.direction, -ray.direction};
        ASSERT_NEAR(whole, mDensity.opticalDepth(back, 0, 1), 1e-13);
    }
}

TEST_F(Noise, OpticalDepth_RaysInCellFaces_EqualTheirLimit) {
    // Along an axis through voxel centres, borders of bricks included, with zeros of both signs.
    for (int y = -12; y <= 12; ++y)
        for (const double zero : {0.0, -0.0}) {
            for (const double sign : {1.0, -1.0}) {
                const IndexRay ray{{-20 * sign, y, 8}, {40 * sign, zero, zero}};
                double sum = 0;
                for (int x = -12; x <= 12; ++x) sum += voxelAt(mField, {x, y, 8});
                ASSERT_NEAR(mDensity.opticalDepth(ray, 0, 1), sum / 40, 1e-13);
            }
        }
}

TEST_F(Noise, OpticalDepth_DiagonalThroughVertices_EqualsQuadrature) {
    for (const dvec3& d : {dvec3(1, 1, 1), dvec3(-1, 1, 1), dvec3(1, -1, 0), dvec3(0, -1, -1)}) {
        const IndexRay ray{-20.0 * d, 40.0 * d};
        ASSERT_NEAR(mDensity.opticalDepth(ray, 0, 1), quadrature(mDensity, ray, 40000), 1e-6);
    }
}

TEST(OpticalDepth_ShearedAndMirrored, IsTheIntegralOverWorldLength) {
    dmat4 m(1);
    m[0] = dvec4(-0.3, 0.05, 0, 0);
    m[1] = dvec4(0.1, 0.2, 0, 0);
    m[2] = dvec4(0, 0.07, 0.5, 0);
    m[3] = dvec4(3, -2, 1, 1);
    const SparseField field = makeNoise(9, 6);
    const VolumeGrid grid = buildVolume(field, "sheared", m);
    const DensityField density(grid);
    const dmat4 indexFromWorld = glm::inverse(m);
    const Box3 bounds = grid.worldBounds();
    RandomRays random(6, bounds.lo - 1.0, bounds.hi + 1.0);
    for (int i = 0; i < 50; ++i) {
        const dvec3 a = random.point(), b = random.point();
        const dvec3 direction = glm::normalize(b - a);
        const double length = glm::length(b - a);
        const IndexRay ray{transformPoint(indexFromWorld, a),
                           transformVector(indexFromWorld, direction)};
        double sum = 0;
        constexpr int kSteps = 20000;
        for (int k = 0; k < kSteps; ++k) {
            const dvec3 p = a + (k + 0.5) / kSteps * (b - a);
            sum += interpolate(field, transformPoint(indexFromWorld, p)) * length / kSteps;
        }
        ASSERT_NEAR(density.opticalDepth(ray, 0, length), sum, 1e-6);
    }
}

TEST(OpticalDepth_OneVoxelSheet, IsSeenAtAnyAngle) {
    SparseField field;
    for (int y = -8; y < 8; ++y)
        for (int x = -8; x < 8; ++x) setVoxel(field, {x, y, 0}, 50);
    const VolumeGrid grid = buildVolume(field, "sheet", dmat4(1));
    const DensityField density(grid);
    for (double slope = 0; slope < 4; slope += 0.13) {
        const dvec3 d(slope, 0.3 * slope, 1);
        EXPECT_NEAR(density.opticalDepth({-3.0 * d, d}, 0, 6), 50, 1e-9);
    }
}

TEST(BrickIndex_HashAndPageTable, FindTheSameBricks) {
    const VolumeGrid near = buildVolume(makeNoise(2, 20), "near", dmat4(1));
    VolumeGrid far = near;
    far.bricks.push_back({ivec3(1 << 28), 1, 0});  // forces the hash table
    const BrickIndex pages(near), hash(far);
    for (int z = -4; z < 4; ++z)
        for (int y = -4; y < 4; ++y)
            for (int x = -4; x < 4; ++x) ASSERT_EQ(pages.find({x, y, z}), hash.find({x, y, z}));
    for (std::uint32_t i = 0; i < far.bricks.size(); ++i)
        ASSERT_EQ(hash.findCell(far.bricks[i].origin + 7), i);
    EXPECT_EQ(pages.find({100, 0, 0}), BrickIndex::kNone);
    EXPECT_EQ(pages.find({-2147483647, 2147483647, 0}), BrickIndex::kNone);
    EXPECT_EQ(hash.find({100, 0, 0}), BrickIndex::kNone);
    EXPECT_EQ(BrickIndex(VolumeGrid{}).find({0, 0, 0}), BrickIndex::kNone);
}

TEST(SampleDensity_FarOutside, IsZero) {
    const VolumeGrid grid = buildVolume(makeNoise(2, 3), "noise", dmat4(1));
    for (const double x : {1e6, 1e12, 1e300, kInfinity})
        EXPECT_EQ(sampleDensity(grid, {x, 0, -x}), 0);
}

}  // namespace
}  // namespace brume::volumes::test
