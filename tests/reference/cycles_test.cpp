// SPDX-License-Identifier: Apache-2.0
// The exact renderer against Blender's Cycles, an independent renderer: real smoke, absorbing and
// scattering.
#include <reference/cycles_images.hpp>
#include <reference/reference.hpp>

#include <gtest/gtest.h>

namespace brume::reference {
namespace {

using test::CyclesDifference;
using test::CyclesImage;

CyclesDifference compare(const CyclesImage& cycles, const scene::Medium& medium,
                         const dvec3& background, const std::vector<scene::Light>& lights,
                         int bands) {
    return test::compareWithCycles(
        cycles, medium, background, lights, bands,
        [](const scene::Scene& scene, const std::vector<volumes::VolumeGrid>& grids) {
            return render({scene, grids, {}}).image;
        });
}

scene::Medium absorbing(double extinction) {
    scene::Medium medium;
    medium.extinction = dvec3(extinction);
    return medium;
}

class ReferenceCycles : public testing::Test {
  protected:
    void SetUp() override {
        if (!test::haveCyclesImages()) GTEST_SKIP() << "needs " << test::cyclesImages();
    }
};

TEST_F(ReferenceCycles, Smoke1Absorption_AgreesTo3e4) {
    const CyclesImage cycles{"reference/smoke1_absorption.exr", test::kSmoke1, 8};
    EXPECT_LE(compare(cycles, absorbing(0.3), dvec3(1), {}, 1).rmse, 3e-4);
}

TEST_F(ReferenceCycles, Fire16Absorption_AgreesTo3e4) {
    const CyclesImage cycles{"reference/fire16_0030_absorption.exr", test::kFire16, 4};
    EXPECT_LE(compare(cycles, absorbing(4), dvec3(1), {}, 1).rmse, 3e-4);
}

TEST_F(ReferenceCycles, Fire16SingleScattering_AgreesToTheNoiseOfCycles) {
    const CyclesImage cycles{"reference/fire16_0030_single_scattering.exr", test::kFire16, 2};
    scene::Medium medium = absorbing(4);
    medium.albedo = dvec3(1);
    scene::Light sun;
    sun.type = scene::LightType::Directional;
    sun.color = dvec3(kPi);
    sun.direction = glm::normalize(dvec3(0.6, -0.7, -0.39));
    sun.shadow = "exact";
    // Cycles' 256 samples per pixel leave white noise of 7.2e-4 (from the fourth differences of its
    // image less those of ours); nothing else remains: means of 16 pixels differ four times less.
    const CyclesDifference difference = compare(cycles, medium, dvec3(0), {sun}, 3);
    EXPECT_LE(difference.rmse, 7.6e-4);
    EXPECT_LE(difference.blockRmse, 2e-4);
}

}  // namespace
}  // namespace brume::reference
