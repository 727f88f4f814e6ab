// SPDX-License-Identifier: Apache-2.0
#include "scene_test_util.hpp"

#include <scene/json_document.hpp>
#include <scene/json_node.hpp>

#include <nlohmann/json.hpp>

namespace brume::scene {
namespace {

using test::messageOf;

JsonRules rules() {
    JsonRules result;
    result.doing = "reading";
    result.name = "a.json";
    return result;
}

std::string parseMessage(const std::string& text) {
    return messageOf([&] { JsonDocument::parse(text, rules()); });
}

TEST(JsonDocument_Places, KeysAndValues_AreWhereTheyStand) {
    const JsonDocument document = JsonDocument::parse(
        "{ \"a\": 1, // one, \"two\": [\n"
        "  \"b\" /* : , { */ : [ -2.5e3,\ttrue,\n"
        "     { \"c\\\"x\": \"s,:\\\\\" } ],\n"
        "  \"d\":null}",
        rules());
    const JsonNode root(document);
    EXPECT_EQ(root.where(), "a.json:1:1");
    EXPECT_EQ(root["a"].where(), "a.json:1:8");
    EXPECT_EQ(root["b"].where(), "a.json:2:21");
    EXPECT_EQ(root["b"].items()[0].where(), "a.json:2:23");
    EXPECT_EQ(root["b"].items()[1].where(), "a.json:2:31");
    const JsonNode inner = root["b"].items()[2];
    EXPECT_EQ(inner.where(), "a.json:3:6");
    EXPECT_EQ(inner["c\"x"].where(), "a.json:3:16");
    EXPECT_EQ(inner["c\"x"].text(), "s,:\\");
    EXPECT_EQ(root["d"].where(), "a.json:4:7");
    EXPECT_STREQ(root.errorAtKey("d", "wrong").what(), "reading: a.json:4:3: key \"d\": wrong");
}

TEST(JsonDocument_Places, ByteOrderMark_DoesNotCount) {
    const JsonDocument document = JsonDocument::parse("\xef\xbb\xbf{\"a\":7}", rules());
    EXPECT_EQ(JsonNode(document)["a"].where(), "a.json:1:6");
}

TEST(JsonDocument_Syntax, Errors_CarryLineAndColumn) {
    EXPECT_EQ(parseMessage("{\n  \"a\": 1,\n}").substr(0, 21), "reading: a.json:3:1: ");
    EXPECT_EQ(parseMessage("{\n  \"a\" 1}").substr(0, 21), "reading: a.json:2:7: ");
    EXPECT_EQ(parseMessage("[1, 2").substr(0, 20), "reading: a.json:1:6:");
    EXPECT_EQ(parseMessage("").substr(0, 20), "reading: a.json:1:1:");
    EXPECT_EQ(parseMessage("[1] 2").substr(0, 20), "reading: a.json:1:5:");
    EXPECT_EQ(parseMessage("[\"\x80\"]").substr(0, 20), "reading: a.json:1:3:");
    const std::string kNoNumber = " is no number, finite ones up to 1e30 are allowed";
    EXPECT_NE(parseMessage("[NaN]").find("NaN" + kNoNumber), std::string::npos);
    EXPECT_NE(parseMessage(R"({ "rate": -Infinity })").find("key \"rate\": -Infinity" + kNoNumber),
              std::string::npos);
    EXPECT_NE(parseMessage(R"({ "rate": 1e999 })").find("key \"rate\": 1e999" + kNoNumber),
              std::string::npos);
    EXPECT_NE(parseMessage("[none]").find("syntax error"), std::string::npos);
}

TEST(JsonDocument_Syntax, ZeroBytes_AreNoEndOfText) {
    EXPECT_EQ(parseMessage(std::string("{ }\n \0{", 7)),
              "reading: a.json:2:2: a zero byte, allowed is text");
}

TEST(JsonDocument_Places, CommentsEnd_AtEveryKindOfLineEnd) {
    const JsonDocument document = JsonDocument::parse("// a comment\r{ \"b\": 3 }", rules());
    EXPECT_EQ(JsonNode(document)["b"].where(), "a.json:1:21");
}

TEST(JsonDocument_Rules, WhatIsForbidden_IsNamedWithItsPlace) {
    EXPECT_EQ(parseMessage("{ \"a\": 1,\n \"b\": 2, \"a\": 3 }"),
              "reading: a.json:2:10: key \"a\": given twice in one object, once is allowed");
    EXPECT_EQ(parseMessage("[1, 2e30]"),
              "reading: a.json:1:5: the number 2e30 is too large, at most 1e30 is allowed");
    EXPECT_NE(parseMessage("[1e999]"), "no error");
    EXPECT_EQ(parseMessage(std::string(70, '[')), "reading: a.json:1:65: nested more than 64 deep");
    EXPECT_EQ(parseMessage("{\"" + std::string(300, 'k') + "\": 1}"),
              "reading: a.json:1:2: a key of 300 bytes, at most 256 are allowed");
}

TEST(JsonDocument_Quote, ControlCharactersAndLength_AreTamed) {
    EXPECT_EQ(quoteForMessage("a\nb\x01"), "a?b?");
    EXPECT_EQ(quoteForMessage("abcdef", 3), "abc...");
    EXPECT_EQ(quoteForMessage("ab\xc3\xa4", 3), "ab...");
}

}  // namespace
}  // namespace brume::scene
