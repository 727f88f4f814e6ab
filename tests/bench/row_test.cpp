// SPDX-License-Identifier: Apache-2.0
// The keys of the machine-readable results, which scripts rely on.
#include <gtest/gtest.h>

#include <bench/row.hpp>
#include <nlohmann/json.hpp>
#include <set>

namespace brume::bench {
namespace {

using Json = nlohmann::json;

std::set<std::string> keysOf(const Json& json) {
    std::set<std::string> keys;
    for (const auto& item : json.items()) keys.insert(item.key());
    return keys;
}

Row makeRow() {
    Row row;
    row.scene = "layers";
    row.method = "linked_list";
    row.shadow = "none";
    row.settings = {{"budgetMiB", "64"}};
    row.width = 4;
    row.height = 2;
    row.device = "device";
    row.driver = "driver";
    row.commit = "abc";
    row.time = {2, 1, 3, 5};
    row.passes = {{"oit.linked_list.resolve", 1.5}};
    row.bytes = {{"total", 80}, {"lists", 48}};
    row.counters = {{"stored", 7}, {"dropped", 0}};
    return row;
}

TEST(RowJson, WithoutComparison_HasExactlyTheContractKeys) {
    const Json json = Json::parse(toJson(makeRow()));
    EXPECT_EQ(keysOf(json),
              (std::set<std::string>{"scene", "method", "shadow", "settings", "size", "device",
                                     "driver", "commit", "timeMs", "passes", "bytes", "counters",
                                     "imageHash"}));
    EXPECT_EQ(keysOf(json["timeMs"]), (std::set<std::string>{"median", "p05", "p95", "repeats"}));
    EXPECT_EQ(json["size"], Json::parse("[4, 2]"));
    EXPECT_EQ(json["settings"]["budgetMiB"], "64");
    EXPECT_EQ(json["passes"][0]["name"], "oit.linked_list.resolve");
    EXPECT_EQ(json["passes"][0]["timeMs"], 1.5);
    EXPECT_EQ(json["bytes"]["total"], 80);
    EXPECT_EQ(json["bytes"]["perPixel"], 10);
    EXPECT_EQ(json["bytes"]["lists"], 48);
    EXPECT_EQ(json["counters"]["stored"], 7);
}

TEST(RowJson, WithComparison_HasExactlyTheErrorKeys) {
    Row row = makeRow();
    row.error = ErrorMetrics{.rmse = 1e-6, .max = 2e-5, .psnr = kInfinity, .excluded = 3};
    const Json error = Json::parse(toJson(row))["error"];
    EXPECT_EQ(keysOf(error), (std::set<std::string>{"rmse", "max", "bias", "p999", "psnr", "flip",
                                                    "nonFinite", "excluded"}));
    row.errorBound = 1e-3;
    EXPECT_EQ(Json::parse(toJson(row))["error"]["bound"], 1e-3);
    EXPECT_EQ(error["rmse"], 1e-6);
    EXPECT_EQ(error["excluded"], 3);
    EXPECT_TRUE(error["psnr"].is_null()) << "JSON has no infinity";
}

TEST(RowJson, Failure_StatesTheReasonInsteadOfTimes) {
    Row row = makeRow();
    row.failure = "out of device memory";
    const Json json = Json::parse(toJson(row));
    EXPECT_EQ(json["failure"], "out of device memory");
    EXPECT_FALSE(json.contains("timeMs"));
}

TEST(RowJson, SeveralRows_StandUnderTheirKey) {
    const std::vector<Row> rows = {makeRow(), makeRow()};
    EXPECT_EQ(Json::parse(toJson(rows, "rows"))["rows"].size(), 2u);
}

TEST(RowJson, NameThatIsNotUtf8_StillGivesJson) {
    Row row = makeRow();
    row.scene = "sm\xff\xfeke";
    EXPECT_TRUE(Json::parse(toJson(row)).contains("scene"));
}

TEST(SimulationJson, Row_HasTheContractKeys) {
    SimulationRow row;
    row.hash = 0xabc;
    row.alive = 3;
    const Json json = Json::parse(toJson(row));
    for (const char* key : {"hash", "alive", "born", "died", "rejected", "timeMs"})
        EXPECT_TRUE(json.contains(key)) << key;
    EXPECT_EQ(json["hash"], "0000000000000abc");
    EXPECT_EQ(json["alive"], 3);
}

}  // namespace
}  // namespace brume::bench
