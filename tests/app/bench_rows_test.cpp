// SPDX-License-Identifier: Apache-2.0
// Every row of the kept results can be had again by its command: its words ask for that row alone.
// (scripts/repeat-rows runs such commands and compares the pictures.)
#include <gtest/gtest.h>

#include <app/command_line.hpp>
#include <bench/method_word.hpp>
#include <bench/scenes.hpp>
#include <core/error.hpp>

#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace brume::app {
namespace {

using Json = nlohmann::json;
using namespace nlohmann::literals;

/// As a shell splits them: all commands of a list at once.
std::vector<std::vector<std::string>> splitByShell(const std::vector<std::string>& commands) {
    const std::filesystem::path script = std::filesystem::temp_directory_path() / "brume_rows.sh";
    {
        std::ofstream stream(script);
        for (const std::string& command : commands)
            stream << "set -- " << command << "\nprintf '%s\\n' \"$@\"\nprintf '\\n'\n";
    }
    std::vector<std::vector<std::string>> all;
    std::vector<std::string> words;
    FILE* pipe = popen(("sh " + script.string()).c_str(), "r");
    std::string word;
    for (int c; pipe && (c = std::fgetc(pipe)) != EOF;) {
        if (c != '\n') {
            word += static_cast<char>(c);
        } else if (word.empty()) {
            all.push_back(std::exchange(words, {}));
        } else {
            words.push_back(std::exchange(word, {}));
        }
    }
    if (pipe) pclose(pipe);
    std::filesystem::remove(script);
    return all;
}

struct KeptRows {
    std::string file, list;
    std::vector<Json> rows;
    std::vector<std::vector<std::string>> words;  // of their commands
};

std::vector<KeptRows> readKeptRows(const std::string& list) {
    std::vector<KeptRows> all;
    for (const auto& entry :
         std::filesystem::directory_iterator(BRUME_SOURCE_DIR "/docs/results")) {
        if (entry.path().extension() != ".json") continue;
        std::ifstream stream(entry.path());
        const Json run = Json::parse(stream);
        KeptRows kept{entry.path().filename().string(), list, {}, {}};
        std::vector<std::string> commands;
        if (run.contains(list))
            for (const Json& row : run[list]) {
                kept.rows.push_back(row);
                commands.push_back(row.at("command"));
            }
        kept.words = splitByShell(commands);
        if (!kept.rows.empty()) all.push_back(std::move(kept));
    }
    return all;
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += word + " ";
    return text;
}

/// Settings that a plan gives to its only method.
std::map<std::string, std::string> settingsOf(const bench::Plan& plan) {
    std::map<std::string, std::string> settings(plan.settings.begin(), plan.settings.end());
    for (const auto& [key, value] : bench::parseMethodWord(plan.methods.at(0)).settings)
        settings[key] = value;
    return settings;
}

TEST(BenchRows, CommandOfEveryRow_AsksForThatRow) {
    int count = 0;
    for (const KeptRows& kept : readKeptRows("rows"))
        for (std::size_t i = 0; i < kept.rows.size(); ++i, ++count) {
            const Json& row = kept.rows[i];
            SCOPED_TRACE(kept.file + ": " + joined(kept.words.at(i)));
            const BenchArguments arguments = parseBenchCommand(kept.words[i]);
            const std::vector<bench::Plan> plans = makePlans(arguments);
            ASSERT_EQ(plans.size(), 1u);
            const bench::Plan& plan = plans[0];
            ASSERT_EQ(plan.methods.size(), 1u);
            EXPECT_EQ(plan.kind, bench::PlanKind::Frames);
            EXPECT_EQ(plan.scene, row.at("scene"));
            EXPECT_EQ(plan.methods[0], row.at("method"));
            EXPECT_EQ(Json({plan.size.x, plan.size.y}), row.at("size"));
            EXPECT_EQ(Json(settingsOf(plan)), row.at("settings"));
            EXPECT_EQ(arguments.repeats, row.at("timeMs").at("repeats"));
            EXPECT_EQ(arguments.withError, row.value("/error/rmse"_json_pointer, -1.0) >= 0);
            if (!plan.shadow.empty()) {
                EXPECT_EQ(plan.shadow, row.at("shadow"));
            }
        }
    EXPECT_GT(count, 200);
}

TEST(BenchRows, CommandOfEveryStoreAndTick_AsksForIt) {
    int count = 0;
    for (const KeptRows& kept : readKeptRows("shadows"))
        for (std::size_t i = 0; i < kept.rows.size(); ++i, ++count) {
            const std::vector<bench::Plan> plans = makePlans(parseBenchCommand(kept.words.at(i)));
            ASSERT_EQ(plans.size(), 1u) << joined(kept.words[i]);
            EXPECT_EQ(plans[0].kind, bench::PlanKind::ShadowPoints);
            EXPECT_EQ(plans[0].scene, kept.rows[i].at("scene"));
            EXPECT_EQ(plans[0].methods, std::vector<std::string>{kept.rows[i].at("shadow")});
        }
    for (const KeptRows& kept : readKeptRows("simulation"))
        for (std::size_t i = 0; i < kept.rows.size(); ++i, ++count)
            EXPECT_EQ(makePlans(parseBenchCommand(kept.words.at(i))).at(0).kind,
                      bench::PlanKind::Simulation);
    EXPECT_GT(count, 10);
}

TEST(BenchGpu, OnlyProcessors_AreRefused) {
    for (const char* type : {"discrete", "integrated", "virtual", "other"})
        EXPECT_NO_THROW(requireGpu({.name = "a device", .type = type})) << type;
    try {
        requireGpu({.name = "a software device", .type = "cpu"});
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Input);
        EXPECT_NE(std::string(error.what()).find("a software device is a processor"), std::string::npos)
            << error.what();
    }
}

TEST(BenchRows, OtherWords_AreNoBenchCommand) {
    EXPECT_ANY_THROW(parseBenchCommand({"brume", "render", "a.json"}));
    EXPECT_ANY_THROW(parseBenchCommand({"brume"}));
}

}  // namespace
}  // namespace brume::app
