// SPDX-License-Identifier: Apache-2.0
// `peel` and `k_buffer`: the nearest layers in their order, and what becomes of the rest.
#include <oit/layer_scenes.hpp>

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

namespace brume::test {
namespace {

/// Sixteen coloured panes in random order, with what the nearest `count` of them show.
struct Stack {
    PaneScene scene{3, dvec3(0.2, 0.4, 0.6)};
    std::vector<std::pair<double, scene::Material>> layers;

    explicit Stack(std::uint64_t seed) {
        Random random(5);
        for (int i = 0; i < 16; ++i)
            layers.emplace_back(1 + 0.1 * i, makeGlowing(random.uniform(0.1, 0.5), random.vector(),
                                                         random.vector()));
        std::vector<std::size_t> order(layers.size());
        std::iota(order.begin(), order.end(), 0);
        std::mt19937 engine(static_cast<unsigned>(seed));
        std::shuffle(order.begin(), order.end(), engine);
        for (const std::size_t i : order)
            scene.addPanes(layers[i].second, std::vector{layers[i].first});
    }

    dvec3 composite(std::size_t count) const {
        dvec3 result = scene.scene.background.radiance;
        for (std::size_t i = count; i-- > 0;) {
            const scene::Material& m = layers[i].second;
            result = m.coverage * (m.emission + m.transmission * result) +
                     (1 - m.coverage) * result;
        }
        return result;
    }
};

void expectPixel(const vec3& actual, const dvec3& expected, double tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(actual[c], expected[c], tolerance);
}

class NearestLayers : public FamilyTest {};

TEST_F(NearestLayers, Peel_ShowsJustTheNearest) {
    const Stack stack(1);
    for (const std::size_t count : {1u, 2u, 5u, 16u, 20u})
        expectPixel(renderWith(stack.scene, "peel", {{"layers", std::to_string(count)}}).at(1, 1),
                    stack.composite(std::min<std::size_t>(count, 16)), 1e-6);
}

TEST_F(NearestLayers, KBufferThatHoldsAll_IsExact) {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const Stack stack(seed);
        for (const char* layers : {"16", "20"})
            expectPixel(renderWith(stack.scene, "k_buffer", {{"layers", layers}}).at(1, 1),
                        stack.composite(16), 1e-6);
    }
}

TEST_F(NearestLayers, KBuffer_DoesNotDependOnTheOrder) {
    std::vector<dvec3> pixels;
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u})
        pixels.emplace_back(
            renderWith(Stack(seed).scene, "k_buffer", {{"layers", "5"}}).at(1, 1));
    // Sums of the tail round by their order.
    for (const dvec3& pixel : pixels) expectPixel(vec3(pixel), pixels[0], 1e-6);
}

TEST_F(NearestLayers, KBuffer_GetsCloserWithEveryLayer) {
    const Stack stack(2);
    double last = 1;
    for (const char* layers : {"1", "4", "8", "12", "16"}) {
        const dvec3 error(
            dvec3(renderWith(stack.scene, "k_buffer", {{"layers", layers}}).at(1, 1)) -
            stack.composite(16));
        RecordProperty(std::string("error_") + layers, fmt::format("{:.3e}", glm::length(error)));
        EXPECT_LT(glm::length(error), last + 1e-3) << layers;
        last = glm::length(error);
    }
}

TEST_F(NearestLayers, EqualDistances_AreKeptApart) {
    PaneScene s(2, dvec3(0));
    for (int i = 0; i < 4; ++i) s.addPanes(makeGlowing(0.5, dvec3(1)), std::vector{1.0});
    EXPECT_NEAR(renderWith(s, "k_buffer", {{"layers", "4"}}).at(0, 0).x, 1 - std::pow(0.5, 4),
                1e-6);
}

TEST_F(NearestLayers, MixedScene_BothAgreeWhereTheyHoldAll) {
    const TestScene s = makeMixedScene(32);
    const Image expected = renderReferenceOf(s);
    const Image peeled = renderWith(s, "peel", {{"layers", "24"}});
    const Image kept = renderWith(s, "k_buffer", {{"layers", "24"}});
    EXPECT_LE(computeRmse(peeled, kept), 1e-5);
    const double rmse = computeRmse(kept, expected);
    RecordProperty("rmse", fmt::format("{:.3e}", rmse));
    EXPECT_LE(rmse, 0.03) << "media are not mixed";
}

}  // namespace
}  // namespace brume::test
