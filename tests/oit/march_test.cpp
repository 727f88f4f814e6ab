// SPDX-License-Identifier: Apache-2.0
// Method march: exact where nothing changes along a step, and as exact as its steps are short.
#include <oit/layer_scenes.hpp>

#include <fmt/format.h>

#include <cmath>

namespace brume::test {
namespace {

const scene::Settings kNoStop = {{"epsilon", "0"}};

scene::Settings stepOf(const char* voxels) { return {{"epsilon", "0"}, {"step", voxels}}; }

/// A coloured field of noise in lamp light, with nothing else.
TestScene makeField() {
    TestScene s(24, 24);
    s.addMedium(dvec3(2, 3, 4), dvec3(0.9, 0.5, 0.2), dvec3(0.2));
    fillBricks(s.addGrid(0, glm::scale(translation(dvec3(-0.8)), dvec3(0.1))), 2, noiseAt);
    s.addDaylight();
    s.addLight(scene::LightType::Point, dvec3(3)).position = dvec3(-1, -2, -1.5);
    s.scene.lights.back().radius = 0.5;
    return s;
}

class March : public RenderTest {
  protected:
    render::Result march(const TestScene& scene, const scene::Settings& settings) {
        return render(scene, {.method = "march", .settings = settings});
    }
    double measureError(const TestScene& scene, const Image& truth, const char* step) {
        return computeRmse(march(scene, stepOf(step)).image, truth);
    }
};

TEST_F(March, ConstantMediaOneBehindTheOther_AreExactWhateverTheStep) {
    TestScene s(32, 32);
    for (int i = 0; i < 3; ++i)
        s.addSphere(s.addMedium(dvec3(1, 2, 3) * (1.0 + i), dvec3(0.9, 0.6, 0.3), dvec3(0.1 * i)),
                    dvec3(0.1 * i, 0, i - 1), 0.45);
    s.addBox(0, dvec3(-0.7, -0.7, 2), dvec3(0.8, 0.3, 3), 0.5f);
    s.addMesh(scene::makeBox(dvec3(0.4)), s.addMaterial(makeOpaque(dvec3(0.5))),
              translation(dvec3(0.2, 0.1, 1)));
    s.addDaylight();
    for (const char* step : {"64", "1"}) {
        mMethod = {.method = "march", .settings = stepOf(step)};
        const render::Result result = march(s, stepOf(step));
        EXPECT_EQ(result.counters.at("exhausted"), 0u);
        EXPECT_GT(result.counters.at("steps"), 0u);
        const render::Result exact = render(s, {.method = "tile", .settings = kNoStop});
        for (std::size_t i = 0; i < exact.image.pixels.size(); ++i)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(result.image.pixels[i][c], exact.image.pixels[i][c], 1e-5) << i;
    }
}

TEST_F(March, StepsOfHalfTheLength_QuarterTheError) {
    const TestScene s = makeField();
    const Image truth = renderReferenceOf(s);
    const double coarse = measureError(s, truth, "1"), fine = measureError(s, truth, "0.25");
    const double slope = std::log(coarse / fine) / std::log(4.0);
    RecordProperty("rmse", fmt::format("{:.2e} {:.2e} slope {:.2f}", coarse, fine, slope));
    EXPECT_GT(coarse, 1e-5) << "worth measuring";
    EXPECT_LT(coarse, 1e-2);
    EXPECT_GT(slope, 1.5) << "the rule of midpoints";
}

TEST_F(March, EarlyStop_TakesFewerStepsAndChangesLittle) {
    TestScene s = makeField();
    s.scene.media[0].extinction *= 20.0;
    const render::Result whole = march(s, kNoStop);
    const render::Result stopped = march(s, {{"epsilon", "0.001"}});
    EXPECT_LT(stopped.counters.at("steps"), whole.counters.at("steps"));
    const double error = computeRmse(stopped.image, whole.image);
    EXPECT_GT(error, 0);
    EXPECT_LT(error, 0.001);
}

TEST_F(March, LongerSteps_AreFewer) {
    const TestScene s = makeField();
    const auto countSteps = [&](const char* step) {
        return static_cast<double>(march(s, stepOf(step)).counters.at("steps"));
    };
    EXPECT_NEAR(countSteps("0.1") / countSteps("0.2"), 2, 0.1);
}

}  // namespace
}  // namespace brume::test
