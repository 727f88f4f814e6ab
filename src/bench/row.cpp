// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <bench/row.hpp>
#include <cctype>
#include <nlohmann/json.hpp>

#include "brume_commit.hpp"

namespace brume::bench {
namespace {

using Json = nlohmann::ordered_json;

Json errorJson(const ErrorMetrics& e) {
    return {{"rmse", e.rmse},           {"max", e.max},          {"bias", e.bias},
            {"p999", e.p999},           {"psnr", e.psnr},        {"flip", e.flip},
            {"nonFinite", e.nonFinite}, {"excluded", e.excluded}};
}

Json timeJson(const TimeSummary& time) {
    return {
        {"median", time.median}, {"p05", time.p05}, {"p95", time.p95}, {"repeats", time.repeats}};
}

Json passJson(const PassRow& pass) {
    Json json = {{"name", pass.name}, {"timeMs", pass.time.median}};
    if (pass.time.repeats > 1) json["p05"] = pass.time.p05, json["p95"] = pass.time.p95;
    json["bytes"] = pass.bytes;
    if (pass.fragments > 0) json["fragments"] = pass.fragments;
    if (pass.roofMs > 0) json["roofMs"] = pass.roofMs;
    return json;
}

Json bytesJson(const Row& row) {
    Json bytes = Json::object();
    const auto total = row.bytes.find("total");
    bytes["total"] = total == row.bytes.end() ? 0 : total->second;
    bytes["perPixel"] =
        bytes["total"].get<double>() / (static_cast<double>(row.width) * row.height);
    for (const auto& [kind, count] : row.bytes)
        if (kind != "total" && kind != "perPixel") bytes[kind] = count;
    return bytes;
}

Json rowJson(const Row& row) {
    Json json = {{"scene", row.scene},
                 {"method", row.method},
                 {"shadow", row.shadow},
                 {"settings", Json::object()},
                 {"size", {row.width, row.height}},
                 {"device", row.device},
                 {"driver", row.driver},
                 {"commit", row.commit}};
    for (const auto& [key, value] : row.settings) json["settings"][key] = value;
    if (!row.suite.empty()) json["suite"] = row.suite;
    if (!row.command.empty()) json["command"] = row.command;
    if (!row.seeds.empty()) json["seeds"] = row.seeds;
    if (!row.failure.empty()) {
        json["failure"] = row.failure;
        return json;
    }
    json["timeMs"] = timeJson(row.time);
    if (row.wall.median > 0) json["wallMs"] = timeJson(row.wall);
    if (row.yardstick.repeats > 0) json["yardstickMs"] = timeJson(row.yardstick);
    json["passes"] = Json::array();
    for (const PassRow& pass : row.passes)
        json["passes"].push_back(passJson(pass));
    json["bytes"] = bytesJson(row);
    json["counters"] = Json::object();
    for (const auto& [name, count] : row.counters) json["counters"][name] = count;
    json["imageHash"] = fmt::format("{:016x}", row.imageHash);
    if (row.error) json["error"] = errorJson(*row.error);
    if (row.errorBound) json["error"]["bound"] = *row.errorBound;
    if (row.layerPixelsPerSecond) json["layerPixelsPerSecond"] = *row.layerPixelsPerSecond;
    return json;
}

/// File names may hold bytes that are not UTF-8; those are replaced instead of thrown at.
std::string dump(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

nlohmann::ordered_json describe(const Row& row) { return rowJson(row); }

std::string toJson(const Row& row) { return dump(rowJson(row)); }

std::string toJson(const SimulationRow& row) {
    return dump({{"effect", row.effect},
                 {"seed", row.seed},
                 {"frames", row.frames},
                 {"dt", row.secondsPerFrame},
                 {"ticks", row.ticks},
                 {"hash", fmt::format("{:016x}", row.hash)},
                 {"alive", row.alive},
                 {"born", row.born},
                 {"died", row.died},
                 {"rejected", row.rejected},
                 {"killed", row.killed},
                 {"timeMs", timeJson(row.time)},
                 {"device", row.device},
                 {"driver", row.driver},
                 {"commit", row.commit}});
}

std::string toJson(const ErrorMetrics& error) { return dump({{"error", errorJson(error)}}); }

std::string toJson(std::span<const Row> rows, const std::string& key) {
    Json json = {{key, Json::array()}};
    for (const Row& row : rows) json[key].push_back(rowJson(row));
    return dump(json);
}

std::string quoteForShell(const std::string& word) {
    const auto isPlain = [](unsigned char c) {
        return std::isalnum(c) || std::string_view("_./:=,+-%@").find(char(c)) != std::string::npos;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), isPlain)) return word;
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

std::string version() { return BRUME_VERSION; }
std::string commit() { return BRUME_COMMIT; }

}  // namespace brume::bench
