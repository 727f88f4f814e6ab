// SPDX-License-Identifier: Apache-2.0
// Shadows inside real smoke against Blender's Cycles, an independent renderer.
#include <reference/cycles_images.hpp>
#include <shadows/shadow_fixture.hpp>

namespace brume::test {
namespace {

class ShadowCycles : public ShadowTest {
  protected:
    void SetUp() override {
        ShadowTest::SetUp();
        if (!haveCyclesImages()) GTEST_SKIP() << "needs " << cyclesImages();
    }

    CyclesDifference compare(const std::string& shadow, int bands) {
        const CyclesImage cycles{"reference/fire16_0030_single_scattering.exr", kFire16, 1};
        TestScene s;
        const std::uint32_t medium = s.addMedium(4, 1);
        addSun(s, shadow, dvec3(0.6, -0.7, -0.39)).color = dvec3(kPi);
        return compareWithCycles(
            cycles, s.scene.media[medium], dvec3(0), s.scene.lights, bands,
            [&](const scene::Scene& scene, const std::vector<volumes::VolumeGrid>& grids) {
                return render({scene, grids, {}}, {.method = "linked_list",
                                                   .settings = {{"shadow.resolution", "128"}}})
                    .image;
            });
    }
};

// Cycles' 256 samples per pixel leave white noise of 7.2e-4, and one sample per pixel adds a little
// where Cycles averages; in means of 16 pixels a quarter of the noise is left.
TEST_F(ShadowCycles, Fire16_ReproducedByVisibility) {
    const CyclesDifference difference = compare("visibility", 1);
    EXPECT_LE(difference.rmse, 1.5e-3);
    EXPECT_LE(difference.blockRmse, 5e-4);
}

TEST_F(ShadowCycles, Fire16_ReproducedExactly) {
    const CyclesDifference difference = compare("exact", 3);
    EXPECT_LE(difference.rmse, 9e-4);
    EXPECT_LE(difference.blockRmse, 2.5e-4);
}

}  // namespace
}  // namespace brume::test
