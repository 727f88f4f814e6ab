// SPDX-License-Identifier: Apache-2.0
// linked_list against Blender's Cycles, an independent renderer: real smoke, absorbing.
#include <reference/cycles_images.hpp>
#include <render/render_fixture.hpp>

namespace brume::test {
namespace {

class Cycles : public RenderTest {
  protected:
    void SetUp() override {
        RenderTest::SetUp();
        if (!haveCyclesImages()) GTEST_SKIP() << "needs " << cyclesImages();
    }

    double computeRmse(const CyclesImage& cycles, double extinction) {
        scene::Medium medium;
        medium.extinction = dvec3(extinction);
        return compareWithCycles(
                   cycles, medium, dvec3(1), {}, 3,
                   [&](const scene::Scene& scene, const std::vector<volumes::VolumeGrid>& grids) {
                       return render({scene, grids, {}}).image;
                   })
            .rmse;
    }
};

TEST_F(Cycles, Smoke1Absorption_AgreesTo3e4) {
    EXPECT_LE(computeRmse({"reference/smoke1_absorption.exr", kSmoke1, 8}, 0.3), 3e-4);
}

TEST_F(Cycles, Fire16Absorption_AgreesTo3e4) {
    EXPECT_LE(computeRmse({"reference/fire16_0030_absorption.exr", kFire16, 4}, 4), 3e-4);
}

}  // namespace
}  // namespace brume::test
