// SPDX-License-Identifier: Apache-2.0
// The exact methods on every built-in scene and every demo that is small enough, at the size of a stamp:
// the reference's image, each other's, and the same bits again, shuffled and in bands.
#include <bench/prepare.hpp>
#include <bench/scenes.hpp>
#include <render/render_fixture.hpp>
#include <scene/loader.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace brume::test {
namespace {

constexpr int kWidth = 20, kHeight = 12;
/// More spheres add time and nothing new.
constexpr std::size_t kMostSpheres = 3000;
/// Pixels that rasteriser and ray caster may see different triangles in, where these are smaller than pixels.
constexpr double kExcludedShare = 0.6;

/// Stores have errors of their own; walking the casters has none.
bool makeShadowsExact(scene::Scene& scene) {
    bool hasShadows = false;
    for (scene::Light& light : scene.lights) {
        if (light.shadow == "none") continue;
        light.shadow = "exact";
        hasShadows = true;
    }
    return hasShadows;
}

class EveryScene : public RenderTest, public testing::WithParamInterface<std::string> {
  protected:
    render::Result renderWith(const render::PreparedScene& scene, const std::string& method,
                              scene::Settings settings) {
        if (method == "tile") settings["epsilon"] = "0";
        return render(scene, {.method = method, .settings = std::move(settings)});
    }

    void expectSameBits(const render::PreparedScene& scene, const std::string& method) {
        const std::uint64_t hash = computeHash(renderWith(scene, method, {}).image);
        for (const scene::Settings& settings :
             {scene::Settings{{"shuffle", "7"}}, scene::Settings{{"budgetMiB", "1"}}})
            EXPECT_EQ(computeHash(renderWith(scene, method, settings).image), hash)
                << method << " with " << settings.begin()->first;
    }

    void expectRight(const render::PreparedScene& scene, const std::string& method) {
        mMethod = {.method = method, .settings = {}};
        if (method == "tile") mMethod.settings = {{"epsilon", "0"}};
        const Difference d = measure(scene);
        EXPECT_EQ(d.nonFinite, 0u) << method;
        EXPECT_LE(d.max, 1e-5 * std::max(1.0, d.largest))
            << fmt::format("{} at ({}, {}), radiances up to {:.3g}, rmse {:.2e}, excluded {}", method,
                           d.worst.x, d.worst.y, d.largest, d.rmse, d.excluded);
        EXPECT_LE(static_cast<double>(d.excluded), kExcludedShare * kWidth * kHeight) << method;
    }
};

TEST_P(EveryScene, IsTheReferencesImageAndAlwaysTheSameBits) {
    for (bench::NamedScene& named : bench::makeScenes(GetParam())) {
        SCOPED_TRACE(named.name);
        named.scene.image = {kWidth, kHeight, 1};
        mWithShadows = makeShadowsExact(named.scene);
        render::PreparedScene scene = bench::prepareNamed(named, log());
        if (scene.spheres.size() > kMostSpheres) scene.spheres.resize(kMostSpheres);
        for (const char* method : {"tile", "linked_list"}) {
            expectRight(scene, method);
            expectSameBits(scene, method);
        }
    }
}

/// Families of which tests of their own look at each member are left out.
std::vector<std::string> listNames() {
    std::vector<std::string> names;
    for (const bench::SceneInfo& info : bench::listScenes())
        if (info.name != "hard" && info.name != "layers" && info.name != "needs")
            names.emplace_back(info.name);
    names.emplace_back("layers_12_800x600");
    return names;
}

INSTANTIATE_TEST_SUITE_P(All, EveryScene, testing::ValuesIn(listNames()),
                         [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace brume::test
