// SPDX-License-Identifier: Apache-2.0
// The exact methods on built-in scenes of many spheres, at the size of a stamp: the reference's image, and
// the same bits again, shuffled and in bands.
#include <bench/scenes.hpp>
#include <render/render_fixture.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace brume::test {
namespace {

constexpr int kWidth = 20, kHeight = 12;
/// More spheres add time and nothing new.
constexpr std::size_t kMostSpheres = 1500;

class ExactBands : public RenderTest {
  protected:
    render::Result renderWith(const render::PreparedScene& scene, const std::string& method,
                              scene::Settings settings) {
        if (method == "tile") settings["epsilon"] = "0";
        return render(scene, {.method = method, .settings = std::move(settings)});
    }
};

class ExactScenes : public ExactBands, public testing::WithParamInterface<std::string> {
  protected:
    void expectSameBits(const render::PreparedScene& scene, const std::string& method) {
        const std::uint64_t hash = computeHash(renderWith(scene, method, {}).image);
        const scene::Settings otherwise = {{"shuffle", "7"}, {"budgetMiB", "1"}};
        EXPECT_EQ(computeHash(renderWith(scene, method, otherwise).image), hash) << method;
    }

    void expectRight(const render::PreparedScene& scene, const std::string& method) {
        mMethod = {.method = method, .settings = {}};
        if (method == "tile") mMethod.settings = {{"epsilon", "0"}};
        const Difference d = measure(scene);
        EXPECT_EQ(d.nonFinite, 0u) << method;
        EXPECT_LE(d.max, 1e-5 * std::max(1.0, d.largest))
            << fmt::format("{} at ({}, {}), radiances up to {:.3g}, rmse {:.2e}, excluded {}", method,
                           d.worst.x, d.worst.y, d.largest, d.rmse, d.excluded);
    }
};

TEST_P(ExactScenes, IsTheReferencesImageAndAlwaysTheSameBits) {
    for (bench::NamedScene& named : bench::makeScenes(GetParam())) {
        SCOPED_TRACE(named.name);
        named.scene.image = {kWidth, kHeight, 1};
        render::PreparedScene scene = bench::prepareNamed(named, log());
        if (scene.spheres.size() > kMostSpheres) scene.spheres.resize(kMostSpheres);
        for (const char* method : {"tile", "linked_list"}) expectRight(scene, method);
        expectSameBits(scene, "tile");
    }
}

TEST_F(ExactBands, Bands_ShowTheSameBits) {
    render::PreparedScene scene = bench::prepareNamed(bench::makeScenes("engine").at(0), log());
    scene.scene.image = {384, 216, 1};
    for (const char* method : {"tile", "linked_list"}) {
        const render::Result whole = renderWith(scene, method, {});
        const render::Result bands = renderWith(scene, method, {{"budgetMiB", "1"}});
        EXPECT_EQ(whole.counters.at("bands"), 1u) << method;
        EXPECT_GT(bands.counters.at("bands"), 1u) << method;
        EXPECT_EQ(bands.counters.at("dropped"), 0u) << method;
        EXPECT_EQ(computeHash(bands.image), computeHash(whole.image)) << method;
    }
}

INSTANTIATE_TEST_SUITE_P(All, ExactScenes,
                         testing::Values("spheres_10k_64", "mixed_10k_15", "mixed_10k_64",
                                         "intervals_8gib", "engine", "frosted_panes", "mixed",
                                         "smoke_and_glass"),
                         [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace brume::test
