// SPDX-License-Identifier: Apache-2.0
// Files of hosts: effects that are read again, volumes that the host reads.
#include <brume/brume_vdb.h>
#include <host/host_fixture.hpp>

#include <filesystem>
#include <fstream>

namespace brume::test {
namespace {

TEST_F(HostTest, ReloadedEffect_ReachesLiveInstances) {
    const std::string folder = ::testing::TempDir() + "brume_host_reload";
    std::filesystem::create_directories(folder);
    const std::string file = folder + "/puffs.effect.json";
    std::ofstream(file) << kEffect;
    const Context context(host().contextInfo());
    Scene scene = makeSceneOfText(context, kSpheresScene, "sorted");
    auto puffs = init<BrumeEffect>();
    puffs.file = file.c_str();
    check(brumeAddEffect(scene.get(), &puffs, nullptr));
    const auto step = [&](double seconds) { return host().show(context, scene, seconds); };
    step(0.5);
    const std::vector<vec4> before = step(0.1);
    EXPECT_EQ(scene.reload(), 0u);
    const auto write = [&](const std::string& text) {
        std::ofstream(file) << text;
        std::filesystem::last_write_time(
            file, std::filesystem::file_time_type::clock::now() + std::chrono::seconds(5));
    };
    write("{ \"version\": 1, \"capacty\": 3 }");
    EXPECT_THROW(scene.reload(), ApiError);
    EXPECT_NE(std::string(brumeLastError()).find("capacty"), std::string::npos);
    EXPECT_EQ(step(0), before) << "after a bad file";
    std::string text = kEffect;
    text.replace(text.find("[1, 0.4]"), 8, "[1, 1.4]");
    write(text);
    EXPECT_EQ(scene.reload(), 1u);
    EXPECT_NE(step(0), before);

    // As if it had always been so.
    Scene fresh = makeSceneOfText(context, kSpheresScene, "sorted");
    check(brumeAddEffect(fresh.get(), &puffs, nullptr));
    const std::vector<vec4> after = step(0);
    EXPECT_EQ(host().show(context, fresh, 0.6), after);
}

TEST_F(HostTest, VolumeOfAFile_IsReadByTheHost) {
    const std::string folder = ::testing::TempDir() + "brume_host_volume";
    std::filesystem::create_directories(folder);
    const std::string file = folder + "/scene.json";
    std::ofstream(file) << R"({ "version": 1,
        "camera": { "position": [0, 0, 5], "target": [0, 0, 0], "verticalFov": 60, "near": 0.1 },
        "image": { "width": 48, "height": 32 }, "background": { "radiance": [0.2, 0.3, 0.4] },
        "lights": [ { "type": "ambient", "radiance": [0.4, 0.5, 0.6] } ],
        "media": { "smoke": { "extinction": [2, 2, 2], "albedo": [0.9, 0.8, 0.7] } },
        "volumes": [ { "file": ")"
                        << BRUME_SOURCE_DIR
                        << R"(/demos/plume/fire.vdb", "density": "density", "medium": "smoke",
                        "transform": { "translate": [0, -1, 0] } } ] })";
    auto info = host().contextInfo();
    EXPECT_THROW(Scene::load(Context(info), file.c_str()), ApiError) << "nobody reads volumes";
    info.readVolume = brumeReadVdb;
    const Context context(info);
    Scene scene = Scene::load(context, file.c_str(), "sorted");
    const std::vector<vec4> seen = host().show(context, scene);
    EXPECT_GT(scene.counters().boxes, 10u);
    EXPECT_LE(largestDifference(seen, renderWhole(file, "sorted")), 1e-6);

    auto density = init<BrumeDensity>();
    EXPECT_EQ(brumeReadVdb(nullptr, file.c_str(), "density", -1, &density),
              BRUME_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::string(brumeVdbLastError()).find("scene.json"), std::string::npos);
}

}  // namespace
}  // namespace brume::test
