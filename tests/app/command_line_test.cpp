// SPDX-License-Identifier: Apache-2.0
// Exit codes, error lines and results of the command, run as a user runs it. What needs a Vulkan
// device is in render_test.cpp.
#include <gtest/gtest.h>

#include <core/image_io.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "process.hpp"

namespace brume::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class CommandLine : public testing::Test {
  protected:
    CommandLine() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        mFolder = fs::temp_directory_path() / (std::string("brume_cli_") + test->name());
        fs::remove_all(mFolder);
        fs::create_directories(mFolder);
    }
    ~CommandLine() override { fs::remove_all(mFolder); }

    std::string path(const std::string& name) const { return (mFolder / name).string(); }

    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(mFolder / name, std::ios::binary) << text;
        return path(name);
    }

    Json readJson(const std::string& name) const {
        return Json::parse(std::ifstream(mFolder / name));
    }

    std::string writeConstant(const std::string& name, const vec3& color, int width = 8) const {
        writeImage(mFolder / name, Image(width, 8, color));
        return path(name);
    }

    fs::path mFolder;
};

void expectUsageError(const Outcome& outcome) {
    EXPECT_EQ(outcome.exitCode, 2) << outcome.out;
    EXPECT_TRUE(isOneErrorLine(outcome.err)) << outcome.err;
}

const char* const kEffect = R"({ "version": 1, "capacity": 1000, "tickRate": 120, "medium": "smoke",
  "emitters": [ { "rate": 500, "shape": { "type": "sphere", "radius": 0.2 }, "speed": [0.5, 1],
                  "direction": [0, 1, 0], "spread": 20, "lifetime": [0.2, 0.4] } ],
  "modules": [ { "type": "gravity", "acceleration": [0, -9.81, 0] } ] })";

TEST_F(CommandLine, WrongUsage_IsOneLineAndCodeTwo) {
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {},
             {"paint"},
             {"render"},
             {"render", "a.json", "--no-such-option"},
             {"render", "a.json", "--frame", "1", "--frames", "1:2"},
             {"render", "a.json", "--repeats", "0"},
             {"compare", "only_one.png"},
             {"list", "colours"},
             {"list", "scenes", "--markdown"},
             {"watch", "scene.json"}})
        expectUsageError(runBrume(arguments));
}

TEST_F(CommandLine, BadValues_AreOneLineAndCodeTwo) {
    const std::string scene = write("scene.json", R"({ "version": 1 })");
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {"render", scene, "--size", "0x10"},
             {"render", scene, "--size", "10"},
             {"render", scene, "--size", "99999999999x1"},
             {"render", scene, "--size", "8x8junk"},
             {"render", scene, "--frames", "3:1"},
             {"render", scene, "--frames", "3"},
             {"render", scene, "--frame", "-1"},
             {"render", scene, "--set", "budget"},
             {"render", scene, "-o", "image.gif"},
             {"render", scene, "--method", "reference", "--set", "steps=3"},
             {"bench", "--scenes", "no_such_scene"},
             {"bench", "--suite", "no_such_suite"},
             {"bench", "--compare", "/no/such.json", "/no/other.json"},
             {"simulate", scene, "--frames", "0"},
             {"simulate", scene, "--dt", "nan"}})
        expectUsageError(runBrume(arguments));
}

TEST_F(CommandLine, HelpAndVersion_GoToTheOutput) {
    for (const char* option : {"--help", "--version"}) {
        const Outcome outcome = runBrume({option});
        EXPECT_EQ(outcome.exitCode, 0);
        EXPECT_NE(outcome.out.find("brume"), std::string::npos);
        EXPECT_EQ(outcome.err, "");
    }
    EXPECT_NE(runBrume({"render", "--help"}).out.find("--against"), std::string::npos);
}

TEST_F(CommandLine, Lists_NameWhatThereIs) {
    const std::pair<const char*, const char*> expected[] = {{"methods", "linked_list"},
                                                            {"shadows", "none"},
                                                            {"modules", "gravity"},
                                                            {"scenes", "spheres_1k_48"}};
    for (const auto& [what, name] : expected) {
        const Outcome outcome = runBrume({"list", what});
        EXPECT_EQ(outcome.exitCode, 0) << what;
        EXPECT_NE(outcome.out.find(name), std::string::npos) << outcome.out;
    }
    const Outcome table = runBrume({"list", "methods", "--markdown"});
    EXPECT_EQ(table.out.substr(0, 10), "| method |");
}

TEST_F(CommandLine, ReadmeTable_IsWhatTheListPrints) {
    std::stringstream readme;
    readme << std::ifstream(BRUME_SOURCE_DIR "/README.md").rdbuf();
    const std::string begin = "<!-- methods -->\n", end = "<!-- /methods -->";
    const std::size_t first = readme.str().find(begin) + begin.size();
    ASSERT_NE(first, std::string::npos + begin.size());
    EXPECT_EQ(readme.str().substr(first, readme.str().find(end) - first),
              runBrume({"list", "methods", "--markdown"}).out)
        << "put the output of `brume list methods --markdown` there";
}

TEST_F(CommandLine, ErrorLine_HidesControlCharacters) {
    const Outcome outcome = runBrume({"inspect", "no\nsuch\x1b[31mfile.vdb"});
    expectUsageError(outcome);
    EXPECT_EQ(outcome.err.find('\x1b'), std::string::npos);
}

TEST_F(CommandLine, Compare_EqualImages_AreZeroEverywhere) {
    const std::string image = writeConstant("a.exr", vec3(0.25f, 0.5f, 2));
    const Outcome outcome = runBrume({"compare", image, image, "--json", path("r.json")});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const Json error = readJson("r.json")["error"];
    for (const char* key : {"rmse", "max", "bias", "p999", "flip", "nonFinite", "excluded"})
        EXPECT_EQ(error[key], 0) << key;
    EXPECT_TRUE(error["psnr"].is_null());
}

TEST_F(CommandLine, Compare_Offset_IsMeasuredWithItsSign) {
    const std::string test = writeConstant("a.exr", vec3(0.75f));
    const std::string reference = writeConstant("b.exr", vec3(0.5f));
    const Outcome outcome =
        runBrume({"compare", test, reference, "--json", path("r.json"), "--diff", path("d.png")});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const Json error = readJson("r.json")["error"];
    EXPECT_EQ(error["rmse"], 0.25);
    EXPECT_EQ(error["bias"], 0.25);
    EXPECT_GT(error["flip"], 0);
    EXPECT_NE(outcome.out.find("rmse      2.500e-01"), std::string::npos) << outcome.out;
    EXPECT_EQ(readImage(mFolder / "d.png").width, 8);
}

TEST_F(CommandLine, Compare_BadFiles_AreRefused) {
    const std::string image = writeConstant("a.exr", vec3(1));
    expectUsageError(runBrume({"compare", image, writeConstant("wide.exr", vec3(1), 9)}));
    expectUsageError(runBrume({"compare", image, path("missing.exr")}));
    expectUsageError(runBrume({"compare", write("junk.exr", "this is no image"), image}));
}

TEST_F(CommandLine, UnwritableResult_IsAFailure) {
    const std::string image = writeConstant("a.exr", vec3(1));
    const Outcome outcome = runBrume({"compare", image, image, "--json", path("no/such/r.json")});
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_TRUE(isOneErrorLine(outcome.err)) << outcome.err;
}

TEST_F(CommandLine, SimulateReference_IsReproducible) {
    const std::string effect = write("sparks.effect.json", kEffect);
    const std::vector<std::string> arguments = {
        "simulate", effect, "--reference", "--frames", "48", "--hash", "--json", path("s.json")};
    const Outcome first = runBrume(arguments);
    ASSERT_EQ(first.exitCode, 0) << first.err;
    const Json json = readJson("s.json");
    EXPECT_EQ(json["born"], 1000);
    EXPECT_EQ(json["born"].get<int>(),
              json["alive"].get<int>() + json["died"].get<int>() + json["rejected"].get<int>());
    EXPECT_EQ(json["timeMs"]["repeats"], 48);
    EXPECT_NE(first.out.find("hash " + json["hash"].get<std::string>()), std::string::npos);
    runBrume(arguments);
    EXPECT_EQ(readJson("s.json")["hash"], json["hash"]);
    std::vector<std::string> other = arguments;
    other.insert(other.end(), {"--seed", "8"});
    runBrume(other);
    EXPECT_NE(readJson("s.json")["hash"], json["hash"]);
}

TEST_F(CommandLine, SimulateReference_FrameLengthDoesNotMatter) {
    const std::string effect = write("sparks.effect.json", kEffect);
    runBrume({"simulate", effect, "--reference", "--frames", "30", "--dt", "0.0333333334", "--json",
              path("a.json")});
    runBrume({"simulate", effect, "--reference", "--frames", "4", "--dt", "0.25", "--json",
              path("b.json")});
    EXPECT_EQ(readJson("a.json")["ticks"], 120);
    EXPECT_EQ(readJson("a.json")["hash"], readJson("b.json")["hash"]);
}

TEST_F(CommandLine, SimulateBadEffects_NameLineKeyAndWhatIsAllowed) {
    struct Fault {
        const char *from, *to;            // in kEffect
        std::vector<const char*> wanted;  // in the message
    };
    for (const Fault& fault : std::vector<Fault>{
             {"\"gravity\"", "\"gravitty\"", {":4:16:", "'gravitty'", "known are gravity, drag"}},
             {"\"acceleration\"", "\"acc\"", {":4:44:", "'acc'", "known are acceleration"}},
             {"\"capacity\"", "\"capacty\"", {":1:17:", "\"capacty\"", "known are $schema, "}},
             {"[0, -9.81, 0]", "\"down\"", {":4:53:", "'acceleration'", "an array of three allowed"}},
             {"[0.2, 0.4]", "-2", {":3:69:", "\"emitters[0].lifetime\"", "a number above 0"}},
             {"-9.81", "NaN", {":4:", "\"acceleration\"", "finite ones up to 1e30 are allowed"}},
             {"-9.81", "1e999", {":4:", "\"acceleration\"", "finite ones up to 1e30 are allowed"}},
             {"\"medium\"", "\"overLife\": { \"radius\": [] }, \"medium\"",
              {":1:", "\"overLife.radius\"", "an array of 1 to 64"}},
             {"\"medium\"", "\"overLife\": { \"radius\": [[0.5, 1], [0.2, 2]] }, \"medium\"",
              {":1:", "\"overLife.radius[1][0]\"", "ages must rise"}},
             {"\"type\": \"gravity\"",
              "\"type\": \"buoyancy\", \"grid\": \"heat\", \"file\": \"none.vdb\"",
              {":4:", "\"modules[0].file\"", "none.vdb", "an existing one is needed"}},
             {"\"medium\"",
              "\"subEmitters\": [ { \"on\": \"death\", \"effect\": \"bad.json\" } ], \"medium\"",
              {":1:", "\"subEmitters[0].effect\"", "effects below each other must differ"}},
             {"1000", "0", {":1:29:", "\"capacity\"", "an integer from 1 to 67108864"}},
             {"1000", "1099511627776", {":1:29:", "\"capacity\"", "an integer from 1 to 67108864"}}}) {
        SCOPED_TRACE(fault.to);
        std::string text = kEffect;
        text.replace(text.find(fault.from), std::string_view(fault.from).size(), fault.to);
        const std::string file = write("bad.json", text);
        const Outcome outcome = runBrume({"simulate", file, "--reference"});
        expectUsageError(outcome);
        EXPECT_NE(outcome.err.find(file), std::string::npos) << outcome.err;
        for (const char* part : fault.wanted)
            EXPECT_NE(outcome.err.find(part), std::string::npos) << part << " in " << outcome.err;
    }
}

TEST_F(CommandLine, InspectEffect_ShowsItWhateverItsName) {
    for (const char* name : {"sparks.effect.json", "sparks.json"}) {
        const Outcome outcome = runBrume({"inspect", write(name, kEffect)});
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
        EXPECT_NE(outcome.out.find("1000 particles"), std::string::npos) << outcome.out;
        EXPECT_NE(outcome.out.find("gravity"), std::string::npos) << outcome.out;
    }
}

TEST_F(CommandLine, InspectScene_ShowsItsParts) {
    const std::string scene = write("scene.json", R"({ "version": 1,
      "media": { "smoke": { "extinction": [4, 4, 4], "albedo": [0.9, 0.9, 0.9] } },
      "spheres": [ { "center": [0, 0, 0], "radius": 1, "medium": "smoke", "density": 1 } ] })");
    const Outcome outcome = runBrume({"inspect", scene});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("smoke"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("needs"), std::string::npos) << outcome.out;
}

TEST_F(CommandLine, BrokenJson_IsRefusedWithItsPlace) {
    for (const char* text :
         {"", "{", "[]", "null", R"({ "version": 2 })", R"({ "version": 1, "camra": {} })",
          R"({ "version": 1, "spheres": 7 })"}) {
        const Outcome outcome = runBrume({"inspect", write("scene.json", text)});
        expectUsageError(outcome);
        EXPECT_NE(outcome.err.find("scene.json:1:"), std::string::npos) << outcome.err;
    }
}

// --- Volumes -----------------------------------------------------------------------------------

/// Memory that a hostile file may cost: 1 GiB on top of the libraries' own address space.
constexpr Limits kTightLimits = {.seconds = 60, .addressMiB = 3072};

class VolumeFiles : public testing::TestWithParam<std::string> {};

TEST_P(VolumeFiles, Hostile_IsShownOrRefusedInOneLine) {
    const fs::path folder = fs::path(BRUME_SHARED_DATA_DIR) / "hard";
    if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not there";
    const Outcome outcome = runBrume({"inspect", (folder / GetParam()).string()}, kTightLimits);
    EXPECT_LT(outcome.maxResidentMiB, 1024);
    if (outcome.exitCode == 0) {
        EXPECT_NE(outcome.out.find("grid"), std::string::npos);
    } else {
        expectUsageError(outcome);
    }
}

INSTANTIATE_TEST_SUITE_P(Hard, VolumeFiles,
                         testing::Values("bad_magic.vdb", "dynamic_range_1e12.vdb", "empty.vdb",
                                         "far_origin.vdb", "frustum.vdb", "half_overflow.vdb",
                                         "multires_fields.vdb", "nan_inf_negative.vdb",
                                         "other_types.vdb", "shear.vdb", "tiles.vdb",
                                         "tiny_voxels.vdb", "truncated.vdb",
                                         "two_voxels_far_apart.vdb", "zero_length.vdb"),
                         [](const auto& file) { return fs::path(file.param).stem().string(); });

TEST_F(CommandLine, InspectUnreadableVolumes_AreRefused) {
    expectUsageError(runBrume({"inspect", path("missing.vdb")}));
    expectUsageError(runBrume({"inspect", write("empty.vdb", "")}));
    expectUsageError(runBrume({"inspect", write("text.nvdb", "not a volume at all")}));
    expectUsageError(runBrume({"inspect", mFolder.string()}));
}

TEST_F(CommandLine, InspectSmoke_PrintsItsGrid) {
    const fs::path file = fs::path(BRUME_SHARED_DATA_DIR) / "vdb/openvdb_smoke1.vdb";
    if (!fs::exists(file)) GTEST_SKIP() << file << " is not there";
    const Outcome outcome = runBrume({"inspect", file.string()}, kTightLimits);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("density"), std::string::npos);
    EXPECT_NE(outcome.out.find("1049275 voxels"), std::string::npos) << outcome.out;
}

TEST_F(CommandLine, InspectSeveralGridsOfOneName_NumbersThem) {
    const fs::path file = fs::path(BRUME_SHARED_DATA_DIR) / "vdb/arnold_grids.vdb";
    if (!fs::exists(file)) GTEST_SKIP() << file << " is not there";
    const Outcome outcome = runBrume({"inspect", file.string()});
    EXPECT_NE(outcome.out.find("density[2]"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace brume::app
