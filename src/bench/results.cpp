// SPDX-License-Identifier: Apache-2.0
#include <bench/results.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace brume::bench {
namespace {

using Json = nlohmann::ordered_json;

Json describe(const Machine& m) {
    return {{"device", m.device},
            {"type", m.type},
            {"driver", m.driver},
            {"api", m.api},
            {"processor", m.processor},
            {"cores", m.cores},
            {"version", m.version},
            {"commit", m.commit},
            {"bytesPerSecond", m.bytesPerSecond},
            {"fragmentsPerSecond", m.fragmentsPerSecond},
            {"samples", m.samples}};
}

Json describe(const SimulationCost& cost) {
    return {{"name", cost.name},
            {"timeMs",
             {{"median", cost.time.median},
              {"p05", cost.time.p05},
              {"p95", cost.time.p95},
              {"repeats", cost.time.repeats}}},
            {"copyRatio", cost.copyRatio},
            {"perSecond", cost.perSecond},
            {"command", cost.command}};
}

}  // namespace

namespace {

std::string dump(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// One row per line: such files are kept and compared.
template <typename Rows, typename Describe>
std::string dumpList(const char* key, const Rows& rows, const Describe& describeRow) {
    std::string text = fmt::format(",\n\"{}\": [", key);
    bool isFirst = true;
    for (const auto& row : rows) {
        text += (isFirst ? "\n" : ",\n") + dump(describeRow(row));
        isFirst = false;
    }
    return text + "]";
}

}  // namespace

std::string toJson(const Results& results) {
    std::string text = "{\"machine\": " + dump(describe(results.machine)) +
                       ",\n\"command\": " + dump(results.command);
    text += dumpList("rows", results.frames, [](const Measurement& m) { return describe(m.row); });
    if (!results.shadows.empty())
        text += dumpList("shadows", results.shadows,
                         [](const ShadowRow& row) { return describe(row); });
    if (!results.simulation.empty())
        text += dumpList("simulation", results.simulation,
                         [](const SimulationCost& cost) { return describe(cost); });
    return text + "}\n";
}

std::string describeMachine(const Machine& m) {
    return fmt::format(
        "Brume {} ({}) on {} ({}), Vulkan {}; {}, {} cores; copies {:.1f} GB/s (read and written), "
        "blends {:.0f} M fragments/s",
        m.version, m.commit, m.device, m.driver, m.api, m.processor, m.cores,
        1e-9 * m.bytesPerSecond, 1e-6 * m.fragmentsPerSecond);
}

std::vector<std::string> listFailures(const Results& results) {
    std::vector<std::string> failures;
    for (const Measurement& m : results.frames)
        if (!m.row.failure.empty())
            failures.push_back(
                fmt::format("{} by {}: {}", m.row.scene, m.row.method, m.row.failure));
    for (const ShadowRow& row : results.shadows)
        if (!row.failure.empty())
            failures.push_back(fmt::format("{} with {}: {}", row.scene, row.store, row.failure));
    return failures;
}

}  // namespace brume::bench
