// SPDX-License-Identifier: Apache-2.0
// Moments of optical depth: one layer, many layers, smoke.
#include <oit/layer_scenes.hpp>

#include <algorithm>
#include <fmt/format.h>

namespace brume::test {
namespace {

class Moment : public FamilyTest {};

TEST_F(Moment, OneLayerAtAnyDistance_IsExact) {
    // Alone, its moments are those of a point: the Hankel matrix has rank one.
    for (const char* precision : {"half", "single"})
        for (const char* moments : {"4", "6", "8"})
            for (const double distance : {0.01, 1.0, 37.0, 1e4}) {
                PaneScene s(2, dvec3(0.2));
                s.addPanes(makeGlowing(0.5, dvec3(1)), std::vector{distance});
                const Image image =
                    renderWith(s, "moment", {{"moments", moments}, {"precision", precision}});
                EXPECT_NEAR(image.at(0, 0).x, 0.6, 1e-5) << moments << precision << distance;
            }
}

TEST_F(Moment, TwoLayers_AreOrdered) {
    for (const char* moments : {"4", "6", "8"}) {
        PaneScene s(2, dvec3(0));
        s.addPanes(makeGlowing(0.75, dvec3(0, 1, 0)), std::vector{2.0});
        s.addPanes(makeGlowing(0.5, dvec3(1, 0, 0)), std::vector{1.0});
        const vec3 pixel = renderWith(s, "moment", {{"moments", moments}}).at(0, 0);
        EXPECT_NEAR(pixel.x, 0.5, 0.01) << moments;
        EXPECT_NEAR(pixel.y, 0.375, 0.01) << moments;
    }
}

TEST_F(Moment, ManyLayersOfAnyOrder_StayFiniteAndClose) {
    for (const int count : {3, 8, 40})
        for (const char* moments : {"4", "6", "8"}) {
            PaneScene s(2, dvec3(0.5));
            Random random(static_cast<std::uint64_t>(count));
            std::vector<std::pair<double, scene::Material>> layers;
            for (int i = 0; i < count; ++i)
                layers.emplace_back(random.uniform(1, 4),
                                    makeGlowing(random.uniform(0, 4.0 / count), random.vector()));
            dvec3 expected(0.5);
            auto sorted = layers;
            std::sort(sorted.begin(), sorted.end(),
                      [](const auto& a, const auto& b) { return a.first > b.first; });
            for (const auto& [distance, m] : sorted)
                expected = glm::mix(expected, m.emission, std::min(m.coverage, 1.0));
            for (auto& [distance, m] : layers) {
                m.coverage = std::min(m.coverage, 1.0);
                s.addPanes(m, std::vector{distance});
            }
            const vec3 pixel = renderWith(s, "moment", {{"moments", moments}}).at(0, 0);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(pixel[c], expected[c], 0.13) << count << " layers, " << moments;
        }
}

TEST_F(Moment, MixedScene_IsCloserThanUnordered) {
    const TestScene s = makeMixedScene(48);
    const Image expected = renderReferenceOf(s);
    const double unordered = computeRmse(renderWith(s, "unordered"), expected);
    for (const char* moments : {"4", "6", "8"}) {
        const double rmse =
            computeRmse(renderWith(s, "moment", {{"moments", moments}}), expected);
        RecordProperty(std::string("rmse_") + moments, fmt::format("{:.3e}", rmse));
        EXPECT_LT(rmse, 0.6 * unordered) << moments;
    }
}

}  // namespace
}  // namespace brume::test
