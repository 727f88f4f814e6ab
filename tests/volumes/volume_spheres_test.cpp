// SPDX-License-Identifier: Apache-2.0
// Volumes as soft spheres: the mass stays.
#include <volumes/support.hpp>
#include <volumes/volume_spheres.hpp>

#include <set>

namespace brume::volumes::test {
namespace {

/// Integral of the density of one sphere over the world, by shells.
double massOf(const scene::MediumSphere& sphere) {
    const double radius = static_cast<double>(sphere.radius);
    double sum = 0;
    constexpr int kShells = 1000;
    for (int i = 0; i < kShells; ++i) {
        const double x = (i + 0.5) / kShells, profile = (1 - x * x) * (1 - x * x);
        sum += 4 * kPi * x * x * profile / kShells;
    }
    return sum * radius * radius * radius * static_cast<double>(sphere.density);
}

TEST(ConvertToSpheres_Voxels, KeepsMassAndCentre) {
    const dmat4 m = glm::scale(glm::translate(dmat4(1), dvec3(5, 0, 0)), dvec3(0.5, 0.25, -1));
    const SparseField field = makeNoise(5, 9);
    double mass = 0;
    dvec3 moment(0);
    for (const VoxelBlock& block : field.blocks)
        for (int i = 0; i < 512; ++i) {
            const double value = static_cast<double>(block.values[i]) * 0.125;
            mass += value;
            moment +=
                value * transformPoint(m, dvec3(block.origin + ivec3(i >> 6, (i >> 3) & 7, i & 7)));
        }
    SphereOptions options;
    options.medium = 3;
    options.firstId = 100;
    const auto spheres = convertToSpheres(buildVolume(field, "noise", m), options);
    ASSERT_FALSE(spheres.empty());
    double sphereMass = 0;
    dvec3 sphereMoment(0);
    std::set<std::uint32_t> ids;
    for (const scene::MediumSphere& sphere : spheres) {
        sphereMass += massOf(sphere);
        sphereMoment += massOf(sphere) * sphere.center;
        ids.insert(sphere.id);
        EXPECT_EQ(sphere.medium, 3u);
        EXPECT_EQ(sphere.profile, scene::Profile::Smooth);
        EXPECT_NEAR(sphere.radius, 2 * std::cbrt(0.125), 1e-6);
    }
    EXPECT_NEAR(sphereMass, mass, 1e-4 * mass);
    EXPECT_LT(glm::length(sphereMoment / sphereMass - moment / mass), 1e-4);
    EXPECT_EQ(ids.size(), spheres.size());
    EXPECT_EQ(*ids.begin(), 100u);
}

TEST(ConvertToSpheres_SoftAndHardBoxes, KeepMass) {
    VolumeGrid grid;
    grid.boxes = {{dvec3(0), dvec3(7), 0.5f, true},
                  {dvec3(16, 1, 3), dvec3(20, 4, 4), 2.0f, false}};
    double mass = 0;
    for (const auto& sphere : convertToSpheres(grid, {})) mass += massOf(sphere);
    EXPECT_NEAR(mass, 0.5 * 512 + 2 * 4 * 3 * 1, 1e-2);
}

TEST(ConvertToSpheres_HugeTile, IsRefusedByName) {
    VolumeGrid grid;
    grid.name = "sky";
    grid.boxes = {{dvec3(0), dvec3(4095), 0.5f, true}};
    EXPECT_NE(inputErrorOf([&] { convertToSpheres(grid, {}); }).find("sky"), std::string::npos);
}

TEST(ConvertToSpheres_Nothing, GivesNothing) { EXPECT_TRUE(convertToSpheres({}, {}).empty()); }

}  // namespace
}  // namespace brume::volumes::test
