// SPDX-License-Identifier: Apache-2.0
// Every method in a host's frame: the same picture as the renderer of whole images.
#include <host/host_fixture.hpp>

#include <filesystem>
#include <fstream>

namespace brume::test {
namespace {

class HostMethods : public HostTest, public ::testing::WithParamInterface<const char*> {};

std::string sceneWithShadow() {
    std::string text = kSpheresScene;
    return text.replace(text.find("[3, 3, 3] }"), 11,
                        R"([3, 3, 3], "shadow": "visibility",
                            "shadowSettings": { "resolution": "64" } })");
}

/// As kSpheresScene, with an effect at 0.5 s. (No shadow: its map's range follows the particles for
/// the renderer, which can look at them, and an estimate for hosts.)
std::string sceneWithEffect(const std::string& folder) {
    std::string text = kSpheresScene;
    std::ofstream(folder + "/puffs.effect.json") << kEffect;
    text.insert(text.rfind("}"), R"(, "effects": [ { "file": "puffs.effect.json", "time": 0.5,
        "transform": { "translate": [0, 0.5, 0.3] } } ])");
    return text;
}

TEST_P(HostMethods, SceneOfAFile_EqualsTheRenderer) {
    const std::string folder = ::testing::TempDir() + "brume_host_" + GetParam();
    std::filesystem::create_directories(folder);
    const std::string file = folder + "/scene.json";
    for (const std::string& text : {sceneWithEffect(folder), sceneWithShadow()}) {
        std::ofstream(file) << text;
        const brume::Image expected = renderWhole(file, GetParam());

        const Context context(host().contextInfo());
        Scene scene = Scene::load(context, file.c_str(), GetParam());
        for (int frame = 0; frame < 3; ++frame) {
            EXPECT_LE(largestDifference(host().show(context, scene), expected), 1e-6)
                << "frame " << frame;
        }
        EXPECT_EQ(host().read()[0].w, 0.25f) << "the host's alpha";
        EXPECT_EQ(scene.counters().shadowPairsDropped, 0u);
        EXPECT_GE(scene.counters().sphereSlots, 2u);
    }
}

INSTANTIATE_TEST_SUITE_P(All, HostMethods,
                         ::testing::Values("sorted", "march", "weighted", "unordered", "moment",
                                           "peel", "k_buffer", "stochastic", "tile",
                                           "linked_list"));

/// 120 spheres that fill the view: more than what is reserved before anything is known.
std::string sceneOfManySpheres() {
    std::string text = R"({ "version": 1,
        "camera": { "position": [0, 0, 5], "target": [0, 0, 0], "verticalFov": 60, "near": 0.1 },
        "image": { "width": 48, "height": 32 }, "background": { "radiance": [0.2, 0.3, 0.4] },
        "lights": [ { "type": "ambient", "radiance": [0.4, 0.5, 0.6] } ],
        "media": { "red": { "extinction": [0.01, 0.01, 0.01], "albedo": [0.9, 0.1, 0.1] },
                   "blue": { "extinction": [0.01, 0.01, 0.01], "albedo": [0.1, 0.1, 0.9] } },
        "spheres": [ )";
    for (int i = 0; i < 120; ++i)
        text += std::string(i > 0 ? ", " : "") + R"({ "center": [0.1, 0.1, )" +
                std::to_string(-0.01 * i) + R"(], "radius": 3.5, "density": 1,
                "medium": ")" +
                (i % 2 ? "red" : "blue") + R"(" })";
    return text + " ] }";
}

class HostLists : public HostTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(HostLists, BeyondTheReservedMemory_SaySoAndGrowWhenPrepared) {
    const std::string file = ::testing::TempDir() + "brume_host_lists_" + GetParam() + ".json";
    std::ofstream(file) << sceneOfManySpheres();
    const brume::Image expected = renderWhole(file, GetParam());

    const Context context(host().contextInfo());
    Scene scene = Scene::load(context, file.c_str(), GetParam());
    scene.prepare(host().view());
    const auto renderFrame = [&] {
        return largestDifference(host().show(context, scene), expected);
    };
    // Of 120 faint layers the nearest stay: right but for what the others would have hidden.
    const double error = renderFrame();
    EXPECT_GT(error, 1e-3);
    EXPECT_LT(error, 0.3);
    const BrumeCounters few = scene.counters();
    EXPECT_GT(few.methodDropped, 0u);
    EXPECT_GE(few.methodBytesWanted, 4u * 120 * 24) << "pairs with 24 tiles";
    int growths = 0;
    while (scene.counters().methodDropped > 0 && growths < 4) {
        scene.prepare(host().view());
        ++growths;
        renderFrame();
    }
    EXPECT_LE(growths, 3);
    EXPECT_LE(renderFrame(), 1e-6);
    EXPECT_EQ(scene.counters().methodDropped, 0u);
    EXPECT_GT(scene.counters().sceneBytes, few.sceneBytes);
}

INSTANTIATE_TEST_SUITE_P(All, HostLists, ::testing::Values("tile", "linked_list"));

}  // namespace
}  // namespace brume::test
