// SPDX-License-Identifier: Apache-2.0
// Pictures, comparison and recording without a window, under validation.
#include <bench/measure.hpp>
#include <bench/prepare.hpp>
#include <core/image_io.hpp>
#include <gpu/gpu_fixture.hpp>
#include <oit/layer_count.hpp>
#include <scene/loader.hpp>
#include <view/programs.hpp>
#include <view/stage.hpp>

#include <shaders/common/heat.h>

#include "scratch_folder.hpp"

#include <chrono>
#include <functional>
#include <thread>

namespace brume::view {
namespace {

constexpr ivec2 kSize(24, 16);
constexpr const char* kMethod = "sorted";  // where it does not matter: its shaders compile fast

class StageTest : public test::GpuTest {
  protected:
    StageTest() { mKeepsPipelines = true; }  // as the viewer does
    void SetUp() override {
        GpuTest::SetUp();
        mStage = std::make_unique<Stage>(device(), mQuiet, mFolder / "scene.json");
        mStage->preview.isEnabled = false;
        mStage->choices[0].method = kMethod;
    }
    void TearDown() override {
        mStage.reset();
        GpuTest::TearDown();
    }

    /// Updates until that holds; fails where it takes a minute.
    void updateUntil(const std::function<bool()>& isReached) {
        const auto start = std::chrono::steady_clock::now();
        do {
            mStage->update(kSize, 1 / 24.0);
            if (std::chrono::steady_clock::now() - start > std::chrono::minutes(1))
                FAIL() << "never reached; " << mStage->message().text;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        } while (!isReached());
    }
    void settle() {
        updateUntil([this] { return mStage->isSettled(); });
    }
    Image shot() {
        const auto file = mFolder / "shot.exr";
        mStage->saveScreenshot(file);
        EXPECT_FALSE(mStage->message().isError) << mStage->message().text;
        return readImage(file);
    }

    const test::ScratchFolder mFolder;
    const Log mQuiet;
    std::unique_ptr<Stage> mStage;
};

TEST_F(StageTest, FirstPicture_IsThatOfTheRenderer) {
    mStage->choices[0].method = "tile";
    settle();
    render::PreparedScene scene =
        bench::prepareScene(scene::loadScene(mFolder / "scene.json", mQuiet), mQuiet);
    scene.scene.image.width = kSize.x;
    scene.scene.image.height = kSize.y;
    render::Renderer renderer(device(), scene, {.method = "tile"}, mQuiet);
    EXPECT_EQ(computeHash(shot()), computeHash(renderer.renderFrame().image));
    EXPECT_TRUE(mStage->pane(0).image());
    EXPECT_GT(mStage->history(0).names().size(), 2u);
}

// What moves, goes on in time or changes its size is what a new renderer makes of it.
TEST_F(StageTest, MovedView_EqualsANewRenderer) {
    settle();
    const std::uint64_t first = computeHash(shot());
    mStage->camera.apply({.turn = {80, 20}});
    mStage->timeline.seek(1.75);
    settle();
    const Image moved = shot();
    EXPECT_NE(computeHash(moved), first);
    render::PreparedScene scene =
        bench::prepareScene(scene::loadScene(mFolder / "scene.json", mQuiet), mQuiet);
    scene.scene.image.width = kSize.x;
    scene.scene.image.height = kSize.y;
    scene.scene.camera = mStage->camera.camera();
    for (auto& effect : scene.scene.effects) effect.time = 1.75;
    render::Renderer renderer(device(), scene, {.method = kMethod}, mQuiet);
    EXPECT_EQ(computeHash(moved), computeHash(renderer.renderFrame().image));
    EXPECT_FALSE(mStage->pane(0).isRebuilt());
    // And back, also in time.
    mStage->camera.reset();
    mStage->timeline.seek(1.5);
    settle();
    EXPECT_EQ(computeHash(shot()), first);
}

// Shadow maps are kept then, with the roundings of the camera that they were built for.
TEST_F(StageTest, MovedCamera_KeepsShadowMaps) {
    for (const char* store : {"total", "exact"}) {
        mStage->choices[0].shadow = store;
        mStage->camera.reset();
        settle();
        mStage->camera.apply({.turn = {-70, 30}});
        settle();
        for (const auto& pass : mStage->pane(0).result().passes)
            EXPECT_FALSE(pass.name.ends_with(".build")) << pass.name;
        const Image moved = shot();
        render::PreparedScene scene =
            bench::prepareScene(scene::loadScene(mFolder / "scene.json", mQuiet), mQuiet);
        scene.scene.camera = mStage->camera.camera();
        bench::overrideShadows(scene.scene, store);
        render::Renderer renderer(device(), scene, {.method = kMethod}, mQuiet);
        const Image fresh = renderer.renderFrame().image;
        float largest = 0;
        for (std::size_t i = 0; i < fresh.pixels.size(); ++i)
            largest = std::max(largest, glm::length(fresh.pixels[i] - moved.pixels[i]));
        EXPECT_LT(largest, 1e-4f) << store;
    }
}

TEST_F(StageTest, ResizedPicture_NeedsNoNewRenderer) {
    settle();
    for (const ivec2 size : {ivec2(31, 17), kSize, ivec2(1, 1)}) {
        mStage->update(size, 1);
        EXPECT_FALSE(mStage->pane(0).isRebuilt());
        EXPECT_EQ(mStage->pane(0).image()->extent().width, static_cast<std::uint32_t>(size.x));
    }
    mStage->update({0, 0}, 1);  // minimised
    EXPECT_TRUE(mStage->pane(0).problem().empty());
}

TEST_F(StageTest, Playing_ChangesThePicture) {
    mStage->choices[0].shadow = "none";
    settle();
    const std::uint64_t before = computeHash(shot());
    mStage->timeline.toggle();
    for (int i = 0; i < 3; ++i) mStage->update(kSize, 0.1);
    mStage->timeline.toggle();
    EXPECT_NEAR(mStage->timeline.now(), 1.8, 1e-9);
    settle();
    EXPECT_NE(computeHash(shot()), before);
}

TEST_F(StageTest, WrongSetting_IsToldAndThePictureStays) {
    mStage->choices[0].shadow = "none";
    settle();
    const PaneChoice good = mStage->choices[0];
    mStage->choices[0].settings["lowResolution"] = "7";
    mStage->update(kSize, 0.1);
    EXPECT_TRUE(mStage->message().isError);
    EXPECT_NE(mStage->message().text.find("lowResolution"), std::string::npos);
    EXPECT_TRUE(mStage->pane(0).image());
    mStage->choices[0] = good;
    settle();
    EXPECT_TRUE(mStage->pane(0).problem().empty());
}

TEST_F(StageTest, OtherMethodAndShadow_AreShownBeside) {
    mStage->isSplit = true;
    mStage->choices[1] = {"unordered", {}, "none"};
    settle();
    EXPECT_EQ(mStage->pane(0).choice().method, kMethod);
    EXPECT_EQ(mStage->pane(1).choice().method, "unordered");
    shot();
    EXPECT_NE(computeHash(readImage(mFolder / "shot.exr")),
              computeHash(readImage(mFolder / "shot-b.exr")));
}

TEST_F(StageTest, Errors_AreMeasuredInTheBackgroundAndCancelledByMovement) {
    mStage->isSplit = true;
    mStage->choices[0] = {"tile", {{"epsilon", "0"}}, "exact"};
    mStage->choices[1] = {"unordered", {}, "exact"};
    mStage->show = Show::Errors;
    updateUntil([this] { return mStage->comparison().divisor == 1; });
    const auto& metrics = mStage->comparison().metrics;
    EXPECT_LT(metrics[0].max, 1e-4);
    EXPECT_GT(metrics[1].rmse, 1e-2);
    EXPECT_EQ(mStage->comparison().errors[1].extent().width, 24u);
    mStage->camera.apply({.turn = {5, 0}});
    mStage->update(kSize, 0.01);
    EXPECT_EQ(mStage->comparison().divisor, 0);
    EXPECT_FALSE(mStage->comparisonProgress());
}

// One pane before a puff before nothing: counted where they are, fragments wherever their boxes
// are.
TEST_F(StageTest, Layers_AreCounted) {
    mStage->camera.setCamera([] {
        scene::Camera camera;
        camera.position = {0.4, 0.6, 4};
        camera.target = {0.4, 0.6, 0};
        return camera;
    }());
    mStage->timeline.seek(0);  // no sparks
    const auto colorAt = [](const Image& image, ivec2 pixel) { return image.at(pixel.x, pixel.y); };
    mStage->show = Show::Layers;
    settle();
    const Image layers = shot();
    const vec3 none = shader::heatColor(0), one = shader::heatColor(oit::layer_count::heatOf(1)),
               two = shader::heatColor(oit::layer_count::heatOf(2));
    EXPECT_EQ(colorAt(layers, {1, 1}), none);
    // The pane covers the middle; behind its left part is the puff.
    EXPECT_LT(glm::length(colorAt(layers, {10, 8}) - two), 1e-3f);
    EXPECT_LT(glm::length(colorAt(layers, {13, 8}) - one), 1e-3f);
    mStage->show = Show::Fragments;
    settle();
    EXPECT_GE(colorAt(shot(), {13, 8}).y, one.y - 1e-3f);
    EXPECT_EQ(mStage->history(0).names().back(), "oit.layer_count.resolve");
}

TEST_F(StageTest, Recording_WritesEveryFrameInTheScenesSize) {
    mStage->choices[0].shadow = "none";
    mStage->timeline.frameRate = 4;
    mStage->timeline.setEnd(0.5);
    mStage->startRecording(mFolder / "f_##.png");
    ASSERT_TRUE(mStage->isRecording());
    updateUntil([this] { return !mStage->isRecording(); });
    EXPECT_FALSE(mStage->message().isError) << mStage->message().text;
    for (const char* name : {"f_00.png", "f_01.png", "f_02.png"})
        EXPECT_EQ(readImage(mFolder / name).width, 24) << name;
    EXPECT_FALSE(std::filesystem::exists(mFolder / "f_03.png"));
}

TEST_F(StageTest, ChangedFile_IsShown) {
    mStage->choices[0].shadow = "none";
    settle();
    const std::uint64_t before = computeHash(shot());
    std::string text = test::kScene;
    text.replace(text.find("0.1, 0.2, 0.3"), 13, "0.9, 0.1, 0.1");
    mFolder.write("scene.json", text);
    updateUntil([this] { return mStage->document.loads() == 2; });
    settle();
    EXPECT_NE(computeHash(shot()), before);
}

// A shader that is edited draws the next picture; one with a mistake is told, and nothing changes.
TEST_F(StageTest, ChangedShader_IsCompiledAndUsed) {
    if (!hasProgram("glslangValidator")) GTEST_SKIP() << "needs glslangValidator";
    std::filesystem::copy(BRUME_SOURCE_DIR "/shaders", mFolder / "shaders",
                          std::filesystem::copy_options::recursive);
    mStage->choices[0] = {"unordered", {}, "none"};
    mStage->watchShaders(mFolder / "shaders");
    settle();
    const Image before = shot();
    const std::string name = "shaders/render/background.frag", original = mFolder.read(name);
    const auto write = [&](const std::string& statement) {
        std::string text = original;
        mFolder.write(name, text.insert(text.find("    opaqueT ="), statement));
    };
    write("    color.rgb = vec3(7.0, 8.0, 9.0)\n");
    updateUntil([this] { return mStage->message().isError; });
    EXPECT_NE(mStage->message().text.find("render/background.frag"), std::string::npos)
        << mStage->message().text;
    EXPECT_EQ(computeHash(shot()), computeHash(before));
    write("    color.rgb = vec3(7.0, 8.0, 9.0);\n");
    updateUntil([this] { return mStage->message().text == "compiled 1 shader"; });
    settle();
    EXPECT_EQ(shot().at(0, 0), vec3(7, 8, 9));
    mFolder.write(name, original);
    updateUntil([this] { return shot().at(0, 0) != vec3(7, 8, 9); });
    settle();
    EXPECT_LE(glm::distance(shot().at(0, 0), before.at(0, 0)), 1e-6f);
}

TEST_F(StageTest, ShadersElsewhere_AreRefused) {
    EXPECT_THROW(mStage->watchShaders(mFolder / ""), Error);
}

// Every shader that the table names is there, and a change of a shared header reaches many.
TEST(ShaderTable_EveryShader, HasItsSource) {
    EXPECT_GT(listShaders().size(), 100u);
    for (const ShaderSource& shader : listShaders()) {
        EXPECT_TRUE(
            std::filesystem::exists(std::string(BRUME_SOURCE_DIR "/shaders/") + shader.file))
            << shader.file;
        EXPECT_EQ(shader.embedded[0], 0x07230203u) << shader.file << " is no SPIR-V";
    }
}

}  // namespace
}  // namespace brume::view
