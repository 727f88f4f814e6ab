// SPDX-License-Identifier: Apache-2.0
// Stochastic transparency on real smoke between two half-covering panes, against the reference.
#include <oit/layer_scenes.hpp>
#include <volumes/vdb_file.hpp>

#include <fmt/format.h>

namespace brume::test {
namespace {

class StochasticRealSmoke : public FamilyTest {
  protected:
    void SetUp() override {
        FamilyTest::SetUp();
        const auto file =
            std::filesystem::path(BRUME_SHARED_DATA_DIR) / "vdb/openvdb_smoke1.vdb";
        if (!std::filesystem::exists(file)) GTEST_SKIP() << "needs " << file;
        constexpr double kExtinction = 0.3;
        mScene.addDaylight();
        mScene.scene.background.radiance = dvec3(0.3, 0.5, 0.9);
        mScene.addMedium(kExtinction, 0.8);
        mScene.scene.volumes.resize(1);
        mScene.scene.volumes[0].file = file;
        mScene.volumes = {volumes::loadVolume(mScene.scene.volumes[0], kExtinction, Log())};
        const Box3 bounds = mScene.volumes[0].worldBounds();
        const dvec3 center = bounds.center(), size = bounds.size();
        mScene.scene.camera.type = scene::CameraType::Orthographic;
        mScene.scene.camera.position = center - dvec3(0, 0, size.z);
        mScene.scene.camera.target = center;
        mScene.scene.camera.height = size.y;
        mScene.addPane(mScene.addMaterial(makeGlowing(0.4, dvec3(0.9, 0.2, 0.1))),
                       bounds.lo.z - 1, 1000);
        mScene.addPane(mScene.addMaterial(makeGlowing(0.6, dvec3(0.1, 0.8, 0.2))),
                       bounds.hi.z + 1, 1000);
        mTruth = renderReferenceOf(mScene);
    }

    double measureError(const char* samples) {
        return computeRmse(
            renderWith(mScene, "stochastic", {{"estimator", "depth_alpha"}, {"samples", samples}}),
            mTruth);
    }

    TestScene mScene{32, 32};
    Image mTruth;
};

TEST_F(StochasticRealSmoke, Basic_IsUnbiased) {
    expectUnbiased(mScene, {{"estimator", "basic"}}, mTruth, 1e-6);
}

TEST_F(StochasticRealSmoke, DepthAlpha_ConvergesToTheTruth) {
    const double few = measureError("4"), many = measureError("64"), most = measureError("1024");
    const double slope = std::log(most / few) / std::log(256.0);
    RecordProperty("rmse", fmt::format("{:.2e} {:.2e} {:.2e} slope {:.2f}", few, many, most, slope));
    EXPECT_LT(many, few);
    // Independent samples give -1/2, strata of one layer -1.
    EXPECT_LE(slope, -0.45);
    EXPECT_GE(slope, -1.1);
}

}  // namespace
}  // namespace brume::test
