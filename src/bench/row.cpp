// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <bench/row.hpp>
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
    if (!row.failure.empty()) {
        json["failure"] = row.failure;
        return json;
    }
    json["timeMs"] = timeJson(row.time);
    json["passes"] = Json::array();
    for (const auto& pass : row.passes)
        json["passes"].push_back({{"name", pass.name}, {"timeMs", pass.timeMs}});
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

std::string version() { return BRUME_VERSION; }
std::string commit() { return BRUME_COMMIT; }

}  // namespace brume::bench
