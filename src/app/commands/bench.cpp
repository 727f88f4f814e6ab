// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <app/commands/bench.hpp>
#include <app/console.hpp>
#include <bench/measure.hpp>
#include <bench/prepare.hpp>
#include <bench/report.hpp>
#include <bench/scenes.hpp>
#include <core/error.hpp>
#include <oit/method_info.hpp>
#include <scene/loader.hpp>

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

/// The scene in every variant that was asked for: one per shadow store.
std::vector<bench::NamedScene> makeVariants(const bench::NamedScene& named,
                                            const BenchArguments& arguments) {
    bench::NamedScene sized = named;
    if (!arguments.size.empty()) {
        const ivec2 size = parseSize(arguments.size);
        sized.scene.image.width = size.x;
        sized.scene.image.height = size.y;
    }
    if (arguments.shadows.empty()) return {sized};
    std::vector<bench::NamedScene> variants;
    for (const std::string& shadow : arguments.shadows) {
        variants.push_back(sized);
        bench::overrideShadows(variants.back().scene, shadow);
    }
    return variants;
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

}  // namespace

void runBench(const BenchArguments& arguments, const Log& log) {
    std::vector<bench::NamedScene> scenes;
    for (const std::string& name : arguments.scenes)
        for (const bench::NamedScene& found : findScenes(name, log))
            for (bench::NamedScene& variant : makeVariants(found, arguments))
                scenes.push_back(std::move(variant));

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
