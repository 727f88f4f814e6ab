// SPDX-License-Identifier: Apache-2.0
// Sequences: parts, checkpoints, a killed run that goes on, volumes that follow the frame.
#include <gtest/gtest.h>

#include <core/image_io.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "process.hpp"

namespace brume::app {
namespace {

namespace fs = std::filesystem;

// Sparks that have children, so that checkpoints hold several populations.
const char* const kChild = R"({ "version": 1, "capacity": 2000, "tickRate": 60, "medium": "smoke",
  "emitters": [ { "speed": [0, 0.1], "direction": [0, 1, 0], "spread": 180, "lifetime": [0.2, 0.4] } ],
  "overLife": { "radius": [[0, 0.02], [1, 0.05]] } })";
const char* const kSparks = R"({ "version": 1, "capacity": 500, "tickRate": 60, "medium": "smoke",
  "emitters": [ { "rate": 200, "shape": { "type": "sphere", "radius": 0.3 }, "speed": [0.5, 1],
                  "direction": [0, 1, 0], "spread": 30, "lifetime": [0.3, 0.8] } ],
  "modules": [ { "type": "gravity", "acceleration": [0, -1, 0] } ],
  "subEmitters": [ { "on": "death", "effect": "child.json", "count": 3 } ],
  "overLife": { "radius": [[0, 0.05], [1, 0.2]] }, "profile": "smooth" })";
const char* const kScene = R"({ "version": 1,
  "image": { "width": 48, "height": 32 },
  "lights": [ { "type": "ambient", "radiance": [1, 1, 1] } ],
  "media": { "smoke": { "extinction": [4, 4, 4], "albedo": [0.9, 0.8, 0.7] } },
  "effects": [ { "file": "sparks.json", "seed": 7 }, { "file": "sparks.json", "seed": 8, "transform": { "translate": [0.5, 0, 0] } } ] })";

class RenderSequence : public testing::Test {
  protected:
    RenderSequence() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        mFolder = fs::temp_directory_path() / (std::string("brume_sequence_") + test->name());
        fs::remove_all(mFolder);
        fs::create_directories(mFolder);
        std::ofstream(mFolder / "child.json") << kChild;
        std::ofstream(mFolder / "sparks.json") << kSparks;
        std::ofstream(mFolder / "scene.json") << kScene;
    }
    ~RenderSequence() override { fs::remove_all(mFolder); }

    std::string path(const std::string& name) const { return (mFolder / name).string(); }

    std::vector<std::string> command(const std::string& folder,
                                     std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {"render", path("scene.json"), "--method",
                                             "linked_list", "-o", path(folder + "/f.###.exr")});
        return arguments;
    }
    Outcome render(const std::string& folder, const std::vector<std::string>& arguments) const {
        return runBrume(command(folder, arguments));
    }

    /// Names and bytes of all files in a folder.
    std::map<std::string, std::string> read(const std::string& folder) const {
        std::map<std::string, std::string> files;
        for (const auto& file : fs::directory_iterator(mFolder / folder)) {
            std::ifstream stream(file.path(), std::ios::binary);
            files[file.path().filename().string()] = {std::istreambuf_iterator<char>(stream),
                                                      std::istreambuf_iterator<char>()};
        }
        return files;
    }

    fs::path mFolder;
};

TEST_F(RenderSequence, Shards_GiveTheFramesOfOneRun) {
    EXPECT_EQ(render("whole", {"--frames", "12:17"}).exitCode, 0);
    EXPECT_EQ(read("whole").size(), 6u);
    const std::vector<std::string> checkpoints{"--checkpoints", path("states"), "--frames",
                                               "12:17"};
    for (const char* shard : {"0/3", "2/3", "3/3", "1/3"}) {
        std::vector<std::string> arguments = checkpoints;
        arguments.insert(arguments.end(), {"--shard", shard});
        const Outcome outcome = render("parts", arguments);
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    }
    EXPECT_EQ(read("states").size(), 6u);  // three frames, two effects
    EXPECT_EQ(read("parts"), read("whole"));
}

// Stands in for Slurm: runs a job at once, or the tasks of an array one after the other.
const char* const kSbatch = R"(#!/bin/sh
set -eu
tasks=
id=1
while :; do
    case $1 in
    --array=1-*) tasks=$(seq "${1#--array=1-}") ;;
    --dependency=afterok:1) id=2 ;;
    --*) ;;
    *) break ;;
    esac
    shift
done
export SLURM_JOB_ID=$id
[ -n "$tasks" ] || sh "$@" >/dev/null
for SLURM_ARRAY_TASK_ID in $tasks; do
    export SLURM_ARRAY_TASK_ID
    sh "$@" >/dev/null
done
echo $id
)";

TEST_F(RenderSequence, SlurmScript_RendersAllFramesInParts) {
    std::ofstream(mFolder / "sbatch") << kSbatch;
    fs::permissions(mFolder / "sbatch", fs::perms::owner_all);
    const std::string command =
        "PATH=" + mFolder.string() +
        ":$PATH BRUME=" BRUME_EXECUTABLE " frames=12:15 parts=2 scene=" + path("scene.json") +
        " output=" + path("out/f.###.exr") +
        " " BRUME_SOURCE_DIR "/scripts/render.sbatch --method sorted >" + path("ids");
    ASSERT_EQ(std::system(command.c_str()), 0);
    std::ifstream ids(mFolder / "ids");
    int id = 0;
    EXPECT_TRUE(ids >> id);
    EXPECT_EQ(id, 2) << "of the array, which waits for the first job";
    for (const char* frame : {"f.012.exr", "f.013.exr", "f.014.exr", "f.015.exr"})
        EXPECT_TRUE(fs::exists(mFolder / "out" / frame)) << frame;
    EXPECT_EQ(read("out/checkpoints").size(), 4u);  // two parts, two effects
}

TEST_F(RenderSequence, FolderOfTheFrames_IsMadeOrNamed) {
    EXPECT_EQ(render("new/folder", {"--frames", "12:13"}).exitCode, 0);
    EXPECT_EQ(read("new/folder").size(), 2u);
    const Outcome outcome = render("scene.json", {"--frames", "12:13"});
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_NE(outcome.err.find("scene.json"), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "") << "nothing is rendered that cannot be written";
}

TEST_F(RenderSequence, SingleFrame_IsThatOfTheSequence) {
    EXPECT_EQ(render("whole", {"--frames", "12:13"}).exitCode, 0);
    EXPECT_EQ(render("one", {"--frame", "13"}).exitCode, 0);
    // Without --frames the name is taken as it stands.
    EXPECT_EQ(read("one").at("f.###.exr"), read("whole").at("f.013.exr"));
}

TEST_F(RenderSequence, RibbonsWithTimesOfTheirOwn_AreThoseOfSingleFrames) {
    std::ofstream(mFolder / "ribbon.json") << R"({ "version": 1, "capacity": 2000, "tickRate": 60,
      "surface": { "type": "ribbon", "material": "trail" }, "emitters": [ { "lifetime": 0.3 } ],
      "overLife": { "radius": [[0, 0.04], [1, 0.01]], "density": [[0, 0.9], [1, 0]] } })";
    std::ofstream(mFolder / "flight.json") << R"({ "version": 1, "capacity": 100, "tickRate": 60,
      "medium": "smoke",
      "emitters": [ { "rate": 20, "speed": [1, 2], "spread": 60, "lifetime": [0.3, 0.8] } ],
      "modules": [ { "type": "gravity" }, { "type": "curl_noise", "strength": 5 } ],
      "subEmitters": [ { "on": "way", "effect": "ribbon.json", "rate": 40 } ],
      "overLife": { "radius": [[0, 0.03]] } })";
    std::ofstream(mFolder / "scene.json") << R"({ "version": 1,
      "camera": { "position": [0, 0.3, 3], "target": [0, 0.3, 0] },
      "image": { "width": 40, "height": 32 },
      "lights": [ { "type": "ambient", "radiance": [1, 1, 1] } ],
      "materials": { "trail": { "type": "thin", "transmission": [0.5, 0.6, 0.9], "reflected": [0.3, 0.2, 0.1] } },
      "media": { "smoke": { "extinction": [4, 4, 4], "albedo": [0.9, 0.8, 0.7] } },
      "effects": [ { "file": "flight.json", "seed": 1, "loop": 0.6, "prewarm": 0.4 },
                   { "file": "flight.json", "seed": 2, "start": 0.55, "timeScale": 1.5 },
                   { "file": "flight.json", "seed": 3, "timeScale": 0, "prewarm": 0.7 } ] })";
    // At 24 Hz frame 13 lies before the second's start, 15 after the first's new beginning.
    Outcome outcome = render("whole", {"--frames", "13:15"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const auto whole = read("whole");
    EXPECT_NE(whole.at("f.013.exr"), whole.at("f.014.exr"));
    outcome = render("one", {"--frame", "15"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(read("one").at("f.###.exr"), whole.at("f.015.exr"));
}

TEST_F(RenderSequence, KilledRun_LeavesWholeFramesAndGoesOn) {
    EXPECT_EQ(render("whole", {"--frames", "1:40"}).exitCode, 0);
    const Outcome killed = runBrumeUntil(command("killed", {"--frames", "1:40"}),
                                         [&] { return fs::exists(mFolder / "killed/f.003.exr"); });
    ASSERT_GE(killed.exitCode, 128) << "it was done before it was killed";
    const auto whole = read("whole");
    std::size_t done = 0;
    for (const auto& [name, bytes] : read("killed")) {
        if (fs::path(name).extension() != ".exr") continue;
        EXPECT_EQ(bytes, whole.at(name)) << name;
        ++done;
    }
    EXPECT_LT(done, whole.size());
    const auto first = fs::last_write_time(mFolder / "killed/f.001.exr");
    EXPECT_EQ(render("killed", {"--frames", "1:40", "--resume"}).exitCode, 0);
    EXPECT_EQ(fs::last_write_time(mFolder / "killed/f.001.exr"), first);
    for (const auto& [name, bytes] : whole) EXPECT_EQ(read("killed").at(name), bytes) << name;
}

TEST_F(RenderSequence, VolumesFollowTheFrame) {
    std::ofstream(mFolder / "scene.json")
        << R"({ "version": 1, "image": { "width": 24, "height": 24 },
      "camera": { "position": [0, 1.5, 8], "target": [0, 1.5, 0] },
      "lights": [ { "type": "ambient", "radiance": [1, 1, 1] } ],
      "media": { "smoke": { "extinction": [4, 4, 4], "albedo": [0.9, 0.8, 0.7] } },
      "volumes": [ { "file": "smoke.##.vdb", "frameOffset": 10, "medium": "smoke" } ] })";
    const fs::path fire = fs::path(BRUME_SOURCE_DIR) / "demos/plume/fire.vdb";
    for (const char* name : {"smoke.10.vdb", "smoke.12.vdb", "smoke.13.vdb"})
        fs::copy_file(fire, mFolder / name);
    EXPECT_EQ(render("still", {}).exitCode, 0);  // frame 0
    EXPECT_EQ(render("moving", {"--frames", "2:3"}).exitCode, 0);
    EXPECT_EQ(read("moving").at("f.002.exr"), read("still").at("f.###.exr"));
    const Outcome outcome = render("missing", {"--frames", "3:4"});
    EXPECT_EQ(outcome.exitCode, 2);
    EXPECT_NE(outcome.err.find("smoke.14.vdb"), std::string::npos) << outcome.err;
    EXPECT_EQ(read("missing").size(), 1u);
}

TEST_F(RenderSequence, CheckpointsOfAnotherSeed_AreRefused) {
    const std::vector<std::string> arguments{"--frames", "12:13", "--checkpoints", path("states")};
    std::vector<std::string> prepare = arguments, other = arguments;
    prepare.insert(prepare.end(), {"--shard", "0/1"});
    EXPECT_EQ(render("parts", prepare).exitCode, 0);
    other.insert(other.end(), {"--seed", "100"});
    const Outcome outcome = render("parts", other);
    EXPECT_EQ(outcome.exitCode, 2);
    EXPECT_TRUE(isOneErrorLine(outcome.err)) << outcome.err;
    EXPECT_NE(outcome.err.find("has seed 7"), std::string::npos) << outcome.err;
}

TEST_F(RenderSequence, OptionsThatMeanNothing_AreRefused) {
    const std::vector<std::vector<std::string>> wrong = {{"--resume"},
                                                         {"--shard", "1/2"},
                                                         {"--checkpoints", path("states")},
                                                         {"--frames", "1:2", "--shard", "0/2"},
                                                         {"--frames", "1:2", "--shard", "3/2"}};
    for (const auto& arguments : wrong) {
        const Outcome outcome = render("parts", arguments);
        EXPECT_EQ(outcome.exitCode, 2);
        EXPECT_TRUE(isOneErrorLine(outcome.err)) << outcome.err;
    }
}

}  // namespace
}  // namespace brume::app
