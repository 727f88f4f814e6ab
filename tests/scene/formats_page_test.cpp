// SPDX-License-Identifier: Apache-2.0
// docs/formats.md knows every key and every word that the schemas allow, and no keys besides.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>

namespace brume::scene {
namespace {

std::string readText(const std::string& name) {
    std::ifstream stream(std::string(BRUME_SOURCE_DIR "/docs/") + name);
    EXPECT_TRUE(stream.good()) << name;
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Names of properties, and the words that values may be.
void collect(const nlohmann::json& schema, std::set<std::string>& keys,
             std::set<std::string>& words) {
    if (schema.is_object())
        for (const auto& [name, value] : schema.items()) {
            if (name == "properties" && value.is_object())
                for (const auto& [key, unused] : value.items()) keys.insert(key);
            if (name == "const" && value.is_string()) words.insert(value.get<std::string>());
            if (name == "enum")
                for (const auto& word : value)
                    if (word.is_string()) words.insert(word.get<std::string>());
        }
    if (schema.is_structured())
        for (const auto& part : schema) collect(part, keys, words);
}

class FormatsPage : public ::testing::TestWithParam<const char*> {};

TEST_P(FormatsPage, KeysAndWordsOfTheSchema_AreAllThere) {
    std::set<std::string> keys, words;
    collect(nlohmann::json::parse(readText(std::string("schema/") + GetParam())), keys, words);
    EXPECT_GT(keys.size(), 30u);
    const std::string page = readText("formats.md");
    for (const std::string& key : keys)
        if (key != "$schema") {
            EXPECT_TRUE(std::regex_search(page, std::regex("[`\".]" + key + "[`\"]"))) << key;
        }
    for (const std::string& word : words)
        EXPECT_NE(page.find('"' + word + '"'), std::string::npos) << word;
}

TEST(FormatsPageTables, KeysOfItsTables_AreInASchema) {
    std::set<std::string> keys, words;
    for (const char* schema : {"scene.schema.json", "effect.schema.json"})
        collect(nlohmann::json::parse(readText(std::string("schema/") + schema)), keys, words);
    const std::string page = readText("formats.md");
    // The first column of a row: | `key` | or | `key`, `key` |; tables of materials have it second.
    const std::regex row(R"(\n\| (?:[a-z, "]*\| )?((?:`[A-Za-z.]+`(?:, )?)+) \|)"),
        key("`(?:[a-z]+\\.)?([A-Za-z]+)`");
    int count = 0;
    for (std::sregex_iterator r(page.begin(), page.end(), row), end; r != end; ++r) {
        const std::string cells = (*r)[1];
        for (std::sregex_iterator k(cells.begin(), cells.end(), key); k != end; ++k, ++count)
            EXPECT_TRUE(keys.count((*k)[1])) << (*k)[1];
    }
    EXPECT_GT(count, 60);
}

INSTANTIATE_TEST_SUITE_P(
    Schemas, FormatsPage, ::testing::Values("scene.schema.json", "effect.schema.json"),
    [](const auto& tested) {
        return std::string(tested.param).substr(0, std::string(tested.param).find('.'));
    });

}  // namespace
}  // namespace brume::scene
