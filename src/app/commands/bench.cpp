// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <app/commands/bench.hpp>
#include <app/console.hpp>
#include <bench/measure.hpp>
#include <bench/prepare.hpp>
#include <bench/report.hpp>
#include <bench/scenes.hpp>
#include <bench/simulation_bench.hpp>
#include <bench/shadow_measure.hpp>
#include <core/error.hpp>
#include <oit/method_info.hpp>
#include <scene/loader.hpp>
#include <shadows/store_info.hpp>

namespace brume::app {
namespace {

std::string listSceneNames() {
    std::string names;
    for (const bench::SceneInfo& scene : bench::listScenes())
        names += std::string(scene.name) + ", ";
    return names;
}

/// A built-in scene, a scene file, or the folder of a demo.
std::vector<bench::NamedScene> findScenes(const std::string& name, const Log& log) {
    std::vector<bench::NamedScene> scenes = bench::makeScenes(name);
    if (!scenes.empty()) return scenes;
    for (const std::filesystem::path& file :
         {std::filesystem::path(name), std::filesystem::path("demos") / name / "scene.json"})
        if (std::filesystem::is_regular_file(file)) {
            scenes.push_back({name, scene::loadScene(file, log)});
            return scenes;
        }
    throw inputError("benchmarking", "scene " + name,
                     "unknown, allowed are " + listSceneNames() + "demos and scene files");
}

std::vector<std::string> findMethods(const std::vector<std::string>& names) {
    std::vector<std::string> methods;
    for (const std::string& name : names) {
        if (name != "all") methods.push_back(name);
        if (name == "all")
            for (const oit::MethodInfo& info : oit::listMethods()) methods.emplace_back(info.name);
    }
    return methods;
}

void resize(const std::string& size, scene::Scene& scene) {
    if (size.empty()) return;
    const ivec2 pixels = parseSize(size);
    scene.image.width = pixels.x;
    scene.image.height = pixels.y;
}

std::vector<std::string> findStores(const std::vector<std::string>& names) {
    if (std::find(names.begin(), names.end(), "all") == names.end()) return names;
    std::vector<std::string> all;
    for (const shadows::StoreInfo& info : shadows::listStores())
        if (info.name != "opaque") all.emplace_back(info.name);  // has no error but its filter
    return all;
}

std::vector<bench::NamedScene> findAllScenes(const BenchArguments& arguments,
                                             const std::vector<std::string>& fallback,
                                             const Log& log) {
    std::vector<bench::NamedScene> scenes;
    for (const std::string& name : arguments.scenes.empty() ? fallback : arguments.scenes)
        for (bench::NamedScene& found : findScenes(name, log)) {
            resize(arguments.size, found.scene);
            scenes.push_back(std::move(found));
        }
    return scenes;
}

void addLayerRates(int layerCount, std::vector<bench::Measurement>& measurements) {
    for (bench::Measurement& m : measurements)
        if (layerCount > 0 && m.row.failure.empty())
            m.row.layerPixelsPerSecond =
                1e3 * layerCount * m.row.width * m.row.height / m.row.time.median;
}

void writeResults(const BenchArguments& arguments, const std::vector<bench::Measurement>& results) {
    fmt::print("{}", bench::formatTable(results));
    if (!arguments.json.empty()) {
        std::vector<bench::Row> rows;
        for (const bench::Measurement& m : results) rows.push_back(m.row);
        bench::writeTextFile(arguments.json, bench::toJson(rows, "rows"));
    }
    if (!arguments.report.empty()) bench::writeReport(arguments.report, results);
}

void benchShadows(const BenchArguments& arguments, const Log& log) {
    bench::ShadowMeasureOptions options;
    options.stores = findStores(arguments.shadows);
    options.settings = parseSettings(arguments.settings);
    options.repeats = std::min(arguments.repeats, 5);
    const std::unique_ptr<gpu::Device> device = openDevice(arguments.device, log);
    std::vector<bench::ShadowRow> rows;
    for (const bench::NamedScene& named :
         findAllScenes(arguments, {"shadow_panes", "shadow_discs"}, log)) {
        Progress progress("measuring " + named.name);
        options.progress = progress.callback();
        for (bench::ShadowRow& row : bench::measureShadows(
                 *device, named.name, bench::prepareScene(named.scene, log), options, log))
            rows.push_back(std::move(row));
    }
    fmt::print("{} ({})\n{}", device->info().name, device->info().driver,
               bench::formatShadowTable(rows));
    if (!arguments.json.empty()) bench::writeTextFile(arguments.json, bench::toJson(rows));
    checkValidation(*device, log);
    for (const bench::ShadowRow& row : rows)
        if (!row.failure.empty())
            throw failure("benchmarking", row.scene + " with " + row.store, row.failure);
}

/// `--scenes simulate`: the particle simulator instead of pictures.
void benchSimulation(const BenchArguments& arguments, const Log& log) {
    constexpr std::uint32_t kParticles = 1'000'000;
    const std::unique_ptr<gpu::Device> device = openDevice(arguments.device, log);
    fmt::print("{} ({}), {} particles, median of {} ticks\n", device->info().name,
               device->info().driver, kParticles, arguments.repeats);
    fmt::print("{}", bench::formatTable(
                         bench::measureSimulation(*device, kParticles, arguments.repeats)));
    checkValidation(*device, log);
}

}  // namespace

void runBench(const BenchArguments& arguments, const Log& log) {
    if (arguments.scenes == std::vector<std::string>{"simulate"})
        return benchSimulation(arguments, log);
    if (!arguments.shadows.empty()) return benchShadows(arguments, log);
    const std::vector<bench::NamedScene> scenes =
        findAllScenes(arguments, {"layers", "spheres_1k_48"}, log);
    bench::MeasureOptions options;
    options.methods = findMethods(arguments.methods);
    options.settings = parseSettings(arguments.settings);
    options.repeats = arguments.repeats;
    options.withError = arguments.withError;
    const std::unique_ptr<gpu::Device> device = openDevice(arguments.device, log);
    fmt::print("{} ({}), median of {} frames\n", device->info().name, device->info().driver,
               arguments.repeats);

    std::vector<bench::Measurement> results;
    for (const bench::NamedScene& named : scenes) {
        Progress progress("measuring " + named.name);
        options.progress = progress.callback();
        std::vector<bench::Measurement> measured = bench::measureScene(
            *device, named.name, bench::prepareScene(named.scene, log), options, log);
        addLayerRates(named.layerCount, measured);
        std::move(measured.begin(), measured.end(), std::back_inserter(results));
    }
    writeResults(arguments, results);
    checkValidation(*device, log);
    for (const bench::Measurement& m : results)
        if (!m.row.failure.empty())
            throw failure("benchmarking", m.row.scene + " by " + m.row.method, m.row.failure);
}

}  // namespace brume::app
