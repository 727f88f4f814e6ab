// SPDX-License-Identifier: Apache-2.0
// The plain questions: every method on every kind of scene, every shadow store, the simulator.
#include <bench/suites/suite.hpp>
#include <shadows/store_info.hpp>

#include <fmt/format.h>

namespace brume::bench {
namespace {

std::vector<std::string> methodScenes(Scale scale) {
    std::vector<std::string> scenes = {"glass_bars",      "frosted_panes", "foggy_street",
                                       "smoke_and_glass", "engine",        "mixed"};
    const std::vector<std::string> large = {"fur", "plume_100k", "spheres_10k_15", "mixed_10k_15"};
    const std::vector<std::string> small = {"fur", "spheres_1k_48", "mixed_1k_48"};
    const auto& more = scale == Scale::Full ? large : small;
    scenes.insert(scenes.end(), more.begin(), more.end());
    return scenes;
}

std::vector<Plan> planMethods(Scale scale) {
    std::vector<Plan> plans;
    for (const std::string& scene : methodScenes(scale))
        plans.push_back({.scene = scene,
                         .methods = listAllMethods(),
                         .size = scale == Scale::Full ? ivec2(640, 360) : ivec2(160, 90)});
    return plans;
}

Findings readMethods(std::span<const Measurement> rows, Scale scale) {
    Table table{.title = "Every method on every scene: ms / rmse",
                .header = {"method"}};
    const std::vector<std::string> scenes = methodScenes(scale);
    table.header.insert(table.header.end(), scenes.begin(), scenes.end());
    for (const std::string& method : listAllMethods()) {
        Cells cells = {method};
        for (const std::string& scene : scenes) {
            const Row* row = findRow(rows, scene, method);
            cells.push_back(row && row->error ? formatMs(row->time.median) + " / " +
                                                    formatError(row->error->rmse)
                                              : "-");
        }
        table.rows.push_back(cells);
    }
    return {.tables = {table}};
}

std::vector<Plan> planShadows(Scale scale) {
    std::vector<std::string> stores;
    for (const shadows::StoreInfo& info : shadows::listStores())
        if (info.name != "opaque") stores.emplace_back(info.name);  // has no error but its filter
    std::vector<Plan> plans;
    for (const char* scene : {"shadow_panes", "shadow_discs", "smoke_and_glass"})
        plans.push_back({.kind = PlanKind::ShadowPoints,
                         .scene = scene,
                         .methods = stores,
                         .settings = {{"resolution", scale == Scale::Full ? "512" : "128"},
                                      {"opaqueResolution", scale == Scale::Full ? "512" : "128"}},
                         .count = scale == Scale::Full ? 2000u : 300u});
    return plans;
}

std::vector<Plan> planSimulation(Scale scale) {
    return {{.kind = PlanKind::Simulation,
             .count = scale == Scale::Full ? 1'000'000u : 100'000u}};
}

Findings readNothing(std::span<const Measurement>, Scale) { return {}; }

}  // namespace

extern const Suite kMethodsSuite = {"methods", "every method on every kind of scene", &planMethods,
                                    &readMethods};
extern const Suite kShadowsSuite = {"shadows", "every shadow store, at points", &planShadows,
                                    &readNothing};
extern const Suite kSimulationSuite = {"simulation", "ticks of the particle simulator beside a copy",
                                       &planSimulation, &readNothing};

}  // namespace brume::bench
