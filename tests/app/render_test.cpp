// SPDX-License-Identifier: Apache-2.0
// `brume render` and `brume bench` from outside, on whatever Vulkan device there is.
#include <gtest/gtest.h>

#include <core/image_io.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "process.hpp"

namespace brume::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// A glass pane, a smooth and a constant sphere that overlap, lit, over an opaque floor.
const char* const kScene = R"({ "version": 1,
  "camera": { "type": "perspective", "position": [0, 1, 5], "target": [0, 0.5, 0], "up": [0, 1, 0], "verticalFov": 40 },
  "image": { "width": 96, "height": 64 },
  "background": { "radiance": [0.1, 0.2, 0.3] },
  "lights": [ { "type": "ambient", "radiance": [0.3, 0.3, 0.3] },
              { "type": "directional", "direction": [0.6, -0.7, -0.39], "irradiance": [3, 3, 3] } ],
  "materials": { "floor": { "type": "opaque", "albedo": [0.5, 0.5, 0.5] },
                 "pane": { "type": "thin", "coverage": 1, "transmission": [0.9, 0.2, 0.1] } },
  "media": { "smoke": { "extinction": [2, 3, 4], "albedo": [0.9, 0.8, 0.7] } },
  "meshes": [ { "shape": "plane", "size": [10, 10], "material": "floor" },
              { "shape": "box", "size": [1, 1, 0.1], "material": "pane", "transform": { "translate": [0, 0.7, 0.5] } } ],
  "spheres": [ { "center": [0, 0.6, 0], "radius": 0.7, "medium": "smoke", "density": 1, "profile": "smooth" },
               { "center": [0.5, 0.6, 0.3], "radius": 0.5, "medium": "smoke", "density": 0.5, "profile": "constant" } ] })";

const char* const kSparks = R"({ "version": 1, "capacity": 500, "tickRate": 60, "medium": "smoke",
  "emitters": [ { "rate": 200, "shape": { "type": "sphere", "radius": 0.3 }, "speed": [0.5, 1],
                  "direction": [0, 1, 0], "spread": 30, "lifetime": [1, 2] } ],
  "modules": [ { "type": "gravity", "acceleration": [0, -1, 0] } ],
  "overLife": { "radius": [[0, 0.05], [1, 0.2]] }, "profile": "smooth" })";

const char* const kEffectScene = R"({ "version": 1,
  "image": { "width": 64, "height": 48 },
  "lights": [ { "type": "ambient", "radiance": [1, 1, 1] } ],
  "media": { "smoke": { "extinction": [4, 4, 4], "albedo": [0.9, 0.8, 0.7] } },
  "effects": [ { "file": "sparks.effect.json", "seed": 7, "time": 1.5 } ] })";

class RenderCommandLine : public testing::Test {
  protected:
    RenderCommandLine() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        mFolder = fs::temp_directory_path() / (std::string("brume_render_") + test->name());
        fs::remove_all(mFolder);
        fs::create_directories(mFolder);
        std::ofstream(mFolder / "scene.json") << kScene;
        std::ofstream(mFolder / "sparks.effect.json") << kSparks;
        std::ofstream(mFolder / "sparks.json") << kEffectScene;
    }
    ~RenderCommandLine() override { fs::remove_all(mFolder); }

    std::string path(const std::string& name) const { return (mFolder / name).string(); }
    Json readJson(const std::string& name) const {
        return Json::parse(std::ifstream(mFolder / name));
    }

    /// Runs `brume render scene <arguments>` and expects it to be done without a word on stderr.
    Outcome render(const std::string& scene, std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {"render", path(scene)});
        Outcome outcome = runBrume(arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        return outcome;
    }

    fs::path mFolder;
};

TEST_F(RenderCommandLine, Reference_WritesImageAndRow) {
    const Outcome outcome = render(
        "scene.json", {"--method", "reference", "-o", path("r.exr"), "--json", path("r.json")});
    EXPECT_NE(outcome.out.find("96x64 reference"), std::string::npos) << outcome.out;
    EXPECT_EQ(readImage(mFolder / "r.exr").width, 96);
    const Json json = readJson("r.json");
    EXPECT_EQ(json["method"], "reference");
    EXPECT_EQ(json["size"], Json::parse("[96, 64]"));
    EXPECT_GT(json["timeMs"]["median"], 0);
}

TEST_F(RenderCommandLine, Size_ChangesTheImage) {
    render("scene.json", {"--method", "reference", "-o", path("r.png"), "--size", "33x17"});
    const Image image = readImage(mFolder / "r.png");
    EXPECT_EQ(image.width, 33);
    EXPECT_EQ(image.height, 17);
}

TEST_F(RenderCommandLine, AgainstItsOwnFile_IsZero) {
    render("scene.json", {"--method", "reference", "-o", path("r.exr")});
    render("scene.json",
           {"--method", "reference", "--against", path("r.exr"), "--json", path("r.json")});
    EXPECT_EQ(readJson("r.json")["error"]["max"], 0);
}

TEST_F(RenderCommandLine, LinkedListAgainstReference_IsExact) {
    const Outcome outcome =
        render("scene.json", {"--method", "linked_list", "--against", "reference", "--explain",
                              "--validate", "--json", path("r.json")});
    const Json json = readJson("r.json");
    EXPECT_LE(json["error"]["rmse"], 2e-5);
    EXPECT_LE(json["error"]["max"], 2e-3);
    EXPECT_EQ(json["error"]["nonFinite"], 0);
    EXPECT_LE(json["error"]["excluded"], 96 * 64 / 50);
    EXPECT_EQ(json["counters"]["dropped"], 0);
    EXPECT_GT(json["bytes"]["total"], 0);
    std::set<std::string> passes;
    for (const Json& pass : json["passes"]) passes.insert(pass["name"].get<std::string>());
    EXPECT_TRUE(passes.contains("oit.linked_list.resolve"));
    EXPECT_NE(outcome.out.find("error against reference"), std::string::npos);
}

TEST_F(RenderCommandLine, Particles_AreThoseOfTheReferenceSimulation) {
    render("sparks.json", {"--method", "reference", "-o", path("r.exr")});
    render("sparks.json",
           {"--method", "linked_list", "--against", path("r.exr"), "--json", path("r.json")});
    const Json json = readJson("r.json");
    EXPECT_LE(json["error"]["rmse"], 2e-5);
    EXPECT_GT(json["counters"]["stored"], 100);
}

TEST_F(RenderCommandLine, MovingThinnedCutEffects_AreThoseOfTheReferenceSimulation) {
    const auto withKeys = [](const std::string& keys) {
        return "{ " + keys + std::string(kSparks).substr(1);
    };
    std::ofstream(mFolder / "world.json")
        << withKeys(R"("space": "world", "thinning": { "distance": 3, "least": 0.1 },)");
    std::ofstream(mFolder / "local.json") << kSparks;
    std::ofstream(mFolder / "moving.json") << R"({ "version": 1,
      "camera": { "type": "perspective", "position": [1e6, 1, 5], "target": [1e6, 0.5, 0], "up": [0, 1, 0], "verticalFov": 40 },
      "image": { "width": 64, "height": 48 },
      "lights": [ { "type": "ambient", "radiance": [1, 1, 1] } ],
      "media": { "smoke": { "extinction": [4, 4, 4], "albedo": [0.9, 0.8, 0.7] } },
      "effects": [ { "file": "world.json", "time": 1.5, "transform": { "translate": [1e6, 0, 0] },
                     "path": [[0, [-2, 0, 0]], [1.5, [20, 0, 0]]] },
                   { "file": "local.json", "time": 1.5, "transform": { "translate": [1e6, 0, 0] },
                     "path": [[0, [-2, 0, 0]], [1.5, [1, 0, 0]]] } ] })";
    std::string warnings;
    for (const std::string method : {"reference", "linked_list"}) {
        const bool isReference = method == "reference";
        std::vector<std::string> arguments = {"render", path("moving.json"), "--method", method,
                                              "--particle-budget", "600", "--json", path("r.json")};
        for (const std::string& more :
             isReference ? std::vector<std::string>{"-o", path("r.exr")}
                         : std::vector<std::string>{"--against", path("r.exr")})
            arguments.push_back(more);
        const Outcome outcome = runBrume(arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        warnings = outcome.err;
    }
    EXPECT_NE(warnings.find("the budget leaves room for 600 of 1000 particles"), std::string::npos)
        << warnings;
    const Json json = readJson("r.json");
    EXPECT_LE(json["error"]["rmse"], 2e-5);
    EXPECT_GT(json["counters"]["stored"], 100);
    EXPECT_GT(json["counters"]["particlesRejected"], 10);
    EXPECT_GT(json["counters"]["particlesAlive"], 300);
}

TEST_F(RenderCommandLine, Frames_AreNumberedAndMove) {
    render("sparks.json", {"--method", "reference", "--frames", "23:24", "-o", path("f.##.exr"),
                           "--json", path("f.json")});
    const Image first = readImage(mFolder / "f.23.exr"), second = readImage(mFolder / "f.24.exr");
    EXPECT_NE(computeHash(first), computeHash(second));
    EXPECT_EQ(readJson("f.json")["frames"].size(), 2u);
    // Frame 36 at 24 frames per second is the scene's own time.
    render("sparks.json", {"--method", "reference", "--frame", "36", "-o", path("a.exr")});
    render("sparks.json", {"--method", "reference", "-o", path("b.exr")});
    EXPECT_EQ(computeHash(readImage(mFolder / "a.exr")), computeHash(readImage(mFolder / "b.exr")));
}

TEST_F(RenderCommandLine, Seed_ChangesTheParticles) {
    render("sparks.json", {"--method", "reference", "--seed", "7", "-o", path("a.exr")});
    render("sparks.json", {"--method", "reference", "--seed", "8", "-o", path("b.exr")});
    render("sparks.json", {"--method", "reference", "-o", path("c.exr")});
    EXPECT_NE(computeHash(readImage(mFolder / "a.exr")), computeHash(readImage(mFolder / "b.exr")));
    EXPECT_EQ(computeHash(readImage(mFolder / "a.exr")), computeHash(readImage(mFolder / "c.exr")));
}

TEST_F(RenderCommandLine, UnknownMethodSettingOrDevice_IsOneLineAndCodeTwo) {
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {"--method", "magic"},
             {"--method", "linked_list", "--set", "no_such_setting=1"},
             {"--device", "no such device"}}) {
        std::vector<std::string> words = {"render", path("scene.json")};
        words.insert(words.end(), arguments.begin(), arguments.end());
        const Outcome outcome = runBrume(words);
        EXPECT_EQ(outcome.exitCode, 2) << outcome.out;
        EXPECT_TRUE(isOneErrorLine(outcome.err)) << outcome.err;
    }
}

TEST_F(RenderCommandLine, DeviceOfTheEnvironment_IsUsed) {
    const Outcome outcome =
        runBrume({"render", path("scene.json")}, {.environment = "BRUME_DEVICE=no such device"});
    EXPECT_EQ(outcome.exitCode, 2);
    EXPECT_NE(outcome.err.find("no such device"), std::string::npos) << outcome.err;
}

TEST_F(RenderCommandLine, Bench_GivesOneRowPerSceneAndMethod) {
    const Outcome outcome = runBrume({"bench", "--scenes", "layers_2_800x600," + path("scene.json"),
                                      "--methods", "all", "--size", "64x48", "--repeats", "2",
                                      "--json", path("b.json"), "--report", path("report")});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const Json rows = readJson("b.json")["rows"];
    ASSERT_EQ(rows.size() % 2, 0u);
    EXPECT_GE(rows.size(), 2u);
    for (const Json& row : rows) {
        EXPECT_EQ(row["timeMs"]["repeats"], 2);
        EXPECT_TRUE(row.contains("error")) << row;
        if (row["method"] == "linked_list") {
            EXPECT_LE(row["error"]["rmse"], 2e-5) << row["scene"];
        }
    }
    EXPECT_GT(rows[0]["layerPixelsPerSecond"], 0);
    EXPECT_TRUE(fs::exists(mFolder / "report/report.html"));
    const Json machine = readJson("b.json")["machine"];
    EXPECT_GT(machine["bytesPerSecond"], 1e6);
    EXPECT_GT(machine["fragmentsPerSecond"], 1e6);
    EXPECT_GT(machine["cores"], 0);
}

TEST_F(RenderCommandLine, Bench_CommandOfARow_MeasuresTheSameAgain) {
    const Outcome outcome =
        runBrume({"bench", "--scenes", path("scene.json"), "--methods", "stochastic:samples=8,tile",
                  "--shadow", "visibility", "--set", "shadow.resolution=64", "--set", "epsilon=0",
                  "--size", "24x16", "--repeats", "2", "--json", path("b.json")});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    for (const Json& row : readJson("b.json")["rows"]) {
        std::string command = row["command"];
        ASSERT_TRUE(command.starts_with("brume bench ")) << command;
        command = BRUME_EXECUTABLE + command.substr(5) + " --json " + path("again.json") + " >" +
                  path("log") + " 2>&1";
        ASSERT_EQ(std::system(command.c_str()), 0) << command;
        const Json again = readJson("again.json")["rows"];
        ASSERT_EQ(again.size(), 1u);
        for (const char* key : {"method", "shadow", "settings", "size", "imageHash", "command"})
            EXPECT_EQ(again[0][key], row[key]) << key;
        EXPECT_EQ(again[0]["passes"].size(), row["passes"].size());
    }
}

TEST_F(RenderCommandLine, Bench_CompareSaysWhatIsWorse) {
    const Outcome outcome = runBrume({"bench", "--scenes", "layers_2_16x16", "--methods", "unordered",
                                      "--repeats", "3", "--json", path("a.json")});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(runBrume({"bench", "--compare", path("a.json"), path("a.json")}).exitCode, 0);
    Json worse = readJson("a.json");
    for (const char* figure : {"median", "p05", "p95"})
        worse["rows"][0]["timeMs"][figure] = worse["rows"][0]["timeMs"][figure].get<double>() * 100;
    std::ofstream(mFolder / "b.json") << worse;
    const Outcome compared = runBrume({"bench", "--compare", path("a.json"), path("b.json")});
    EXPECT_EQ(compared.exitCode, 1);
    EXPECT_NE(compared.out.find("100.00 times as long"), std::string::npos) << compared.out;
    EXPECT_TRUE(isOneErrorLine(compared.err)) << compared.err;
    EXPECT_EQ(runBrume({"bench", "--compare", path("b.json"), path("a.json")}).exitCode, 0);
    EXPECT_EQ(runBrume({"bench", "--compare", path("scene.json"), path("a.json")}).exitCode, 2);
}

TEST_F(RenderCommandLine, BenchGpu_WritesOneFileWithoutAWindowOrRefuses) {
    std::vector<std::string> words = {"bench",     "--scenes", "layers_2_16x16", "--methods", "unordered",
                                      "--repeats", "1",        "--json",         path("a.json")};
    ASSERT_EQ(runBrume(words).exitCode, 0);
    const Json machine = readJson("a.json")["machine"];
    words.back() = path("b.json");
    words.push_back("--gpu");
    const Outcome outcome = runBrume(words, {.environment = "DISPLAY=:none"});
    if (machine["type"] == "cpu") {
        EXPECT_EQ(outcome.exitCode, 2);
        EXPECT_TRUE(isOneErrorLine(outcome.err)) << outcome.err;
        EXPECT_NE(outcome.err.find("--gpu"), std::string::npos) << outcome.err;
        EXPECT_FALSE(fs::exists(path("b.json")));
        return;
    }
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const Json run = readJson("b.json");
    for (const char* key : {"device", "type", "driver"}) EXPECT_EQ(run["machine"][key], machine[key]);
    ASSERT_EQ(run["rows"].size(), 1u);
    EXPECT_GT(run["rows"][0]["timeMs"]["median"], 0);
}

TEST_F(RenderCommandLine, BenchSeeds_ThatAreNoNumbersAreOneLine) {
    for (const char* method : {"stochastic:pattern=abc", "unordered:shuffle=99999999999999999999"}) {
        const Outcome outcome = runBrume({"bench", "--scenes", "layers_2_16x16", "--methods", method,
                                          "--repeats", "1"});
        EXPECT_EQ(outcome.exitCode, 1);
        EXPECT_TRUE(isOneErrorLine(outcome.err)) << outcome.err;
        EXPECT_NE(outcome.err.find("must be an integer"), std::string::npos) << outcome.err;
    }
}

TEST_F(RenderCommandLine, RibbonsAndBillboards_AreThoseOfTheReference) {
    std::ofstream(mFolder / "ribbon.json") << R"({ "version": 1, "capacity": 2000, "tickRate": 60,
      "surface": { "type": "ribbon", "material": "trail" }, "emitters": [ { "lifetime": 0.5 } ],
      "overLife": { "radius": [[0, 0.05], [1, 0.02]], "density": [[0, 0.9], [1, 0.1]],
                    "tint": [[0, [1, 1, 1]], [1, [0.3, 0.5, 1]]] }, "profile": "smooth" })";
    std::ofstream(mFolder / "flakes.json") << R"({ "version": 1, "capacity": 60, "tickRate": 60,
      "surface": { "type": "billboard", "material": "flake", "startRotation": [0, 360], "spin": [-90, 90] },
      "emitters": [ { "rate": 40, "shape": { "type": "box", "size": [2, 1, 1] }, "speed": 0.2, "lifetime": 1 } ],
      "overLife": { "radius": [[0, 0.1], [1, 0.2]], "density": [[0, 0.8], [1, 0.2]] } })";
    std::ofstream(mFolder / "flight.json") << R"({ "version": 1, "capacity": 100, "tickRate": 60,
      "medium": "smoke",
      "emitters": [ { "rate": 20, "speed": [1, 2], "spread": 60, "lifetime": [0.5, 1] } ],
      "modules": [ { "type": "gravity" }, { "type": "curl_noise", "strength": 5 } ],
      "subEmitters": [ { "on": "way", "effect": "ribbon.json", "rate": 40 } ],
      "overLife": { "radius": [[0, 0.08]] } })";
    std::ofstream(mFolder / "thin.json") << R"({ "version": 1,
      "camera": { "position": [0, 0.2, 3], "target": [0, 0.2, 0] },
      "image": { "width": 64, "height": 48 },
      "background": { "radiance": [0.2, 0.3, 0.4] },
      "lights": [ { "type": "ambient", "radiance": [1, 1, 1] } ],
      "materials": { "trail": { "type": "thin", "transmission": [0.5, 0.6, 0.9], "reflected": [0.3, 0.2, 0.1] },
                     "flake": { "type": "thin", "transmission": [0.2, 0.9, 0.3], "emission": [0.5, 0.1, 0] } },
      "media": { "smoke": { "extinction": [4, 4, 4], "albedo": [0.9, 0.8, 0.7] } },
      "effects": [ { "file": "flight.json", "seed": 1, "time": 0.9 },
                   { "file": "flakes.json", "seed": 2, "time": 0.9 } ] })";
    const Outcome outcome =
        runBrume({"bench", "--scenes", path("thin.json"), "--methods",
                  "tile:epsilon=0,linked_list,weighted", "--repeats", "1", "--json", path("b.json")});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const Json rows = readJson("b.json")["rows"];
    ASSERT_EQ(rows.size(), 3u);
    for (const Json& row : rows) {
        const Json& error = row["error"];
        EXPECT_EQ(error["nonFinite"], 0) << row["method"];
        // Edges of triangles, which the rasteriser snaps to sub-pixels.
        EXPECT_LE(error["excluded"], 64 * 48 / 10) << row["method"];
        if (row["method"] == "weighted") {
            EXPECT_GT(error["rmse"], 1e-3);
            EXPECT_LE(error["rmse"], 0.1);
        } else {
            EXPECT_LE(error["rmse"], 1e-4) << row["method"];
        }
    }
}

TEST_F(RenderCommandLine, SimulateOnDevice_EqualsTheReference) {
    const std::string effect = path("sparks.effect.json");
    runBrume({"simulate", effect, "--json", path("a.json")});
    runBrume({"simulate", effect, "--reference", "--json", path("b.json")});
    for (const char* key : {"hash", "alive", "born", "died", "rejected"})
        EXPECT_EQ(readJson("a.json")[key], readJson("b.json")[key]) << key;
}

}  // namespace
}  // namespace brume::app
