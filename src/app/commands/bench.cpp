// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <app/commands/bench.hpp>
#include <app/console.hpp>
#include <bench/report.hpp>
#include <bench/run_diff.hpp>
#include <bench/runner.hpp>
#include <core/error.hpp>
#include <fstream>
#include <oit/method_info.hpp>
#include <scene/loader.hpp>
#include <shadows/store_info.hpp>
#include <sstream>

namespace brume::app {
namespace {

constexpr const char* kDoing = "benchmarking";
/// Repeats, unless asked for. Rows of quick suites are many, and small: those of few milliseconds are
/// repeated as often as in others.
constexpr int kRepeats = 20, kQuickRepeats = 5;

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
    throw inputError(kDoing, "scene " + name,
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

std::vector<std::string> findStores(const std::vector<std::string>& names) {
    if (std::find(names.begin(), names.end(), "all") == names.end()) return names;
    std::vector<std::string> all;
    for (const shadows::StoreInfo& info : shadows::listStores())
        if (info.name != "opaque") all.emplace_back(info.name);  // has no error but its filter
    return all;
}

std::vector<const bench::Suite*> findSuites(const std::vector<std::string>& names) {
    std::vector<const bench::Suite*> suites;
    std::vector<std::string_view> known;
    for (const bench::Suite& suite : bench::listSuites()) known.push_back(suite.name);
    for (const std::string& name : names) {
        if (name == "all")
            for (const bench::Suite& suite : bench::listSuites()) suites.push_back(&suite);
        else if (const bench::Suite* suite = bench::findSuite(name))
            suites.push_back(suite);
        else
            throw inputError(kDoing, "suite " + name,
                             fmt::format("unknown, allowed are all, {}", fmt::join(known, ", ")));
    }
    return suites;
}

std::string readTextFile(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw inputError("comparing runs", file.string(), "cannot be read, is it there?");
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
}

void compareRuns(const BenchArguments& arguments) {
    const std::filesystem::path &before = arguments.compare.at(0), &after = arguments.compare.at(1);
    const bench::RunDiff diff =
        bench::diffRuns(readTextFile(before), before.string(), readTextFile(after), after.string(),
                        arguments.threshold);
    fmt::print("{}", bench::formatDiff(diff));
    if (!diff.regressions.empty())
        throw failure("comparing runs", after.string(),
                      fmt::format("{} of {} rows are worse beyond noise", diff.regressions.size(),
                                  diff.comparedRows));
}

void printResults(const bench::Results& results) {
    fmt::print("{}\n", bench::describeMachine(results.machine));
    if (results.findings.empty()) {
        if (!results.frames.empty()) fmt::print("{}", bench::formatTable(results.frames));
        if (!results.shadows.empty())
            fmt::print("{}", bench::formatCells(bench::makeShadowTable(results.shadows)));
        if (!results.simulation.empty())
            fmt::print("{}", bench::formatCells(bench::makeSimulationTable(results.simulation)));
    }
    for (const bench::Findings& findings : results.findings) {
        fmt::print("\n## {}: {}\n\n", findings.suite, findings.summary);
        for (const bench::Table& table : findings.tables)
            fmt::print("{}", bench::formatMarkdown(table));
    }
}

bench::Results measure(const BenchArguments& arguments, gpu::Device& device, const Log& log) {
    bench::RunOptions options;
    options.repeats = arguments.repeats;
    if (options.repeats == 0) {
        options.repeats = arguments.isQuick ? kQuickRepeats : kRepeats;
        options.shortRepeats = kRepeats;
    }
    options.withError = arguments.withError;
    options.errorEvery = arguments.errorEvery;
    options.keepImages = !arguments.report.empty();
    options.findScenes = [&](const std::string& name) { return findScenes(name, log); };
    Progress progress("measuring");
    options.progress = [&](const std::string& what, double fraction) {
        progress.update(fraction);
        log.info(fmt::format("measuring {}, {:.0f} % of its suite", what, 100 * fraction));
    };
    bench::Yardstick yardstick(device);
    bench::Results results;
    results.command = arguments.command;
    const bench::Scale scale = arguments.isQuick ? bench::Scale::Quick : bench::Scale::Full;
    for (const bench::Suite* suite : findSuites(arguments.suites))
        bench::runSuite(device, yardstick, *suite, scale, options, log, results);
    if (arguments.suites.empty())
        bench::runPlans(device, yardstick, makePlans(arguments), "", options, log, results);
    return results;
}

}  // namespace

std::vector<bench::Plan> makePlans(const BenchArguments& arguments) {
    if (arguments.scenes == std::vector<std::string>{"simulate"})
        return {{.kind = bench::PlanKind::Simulation, .count = arguments.particles}};
    const bool areStores = !arguments.shadows.empty();
    bench::Plan plan;
    plan.kind = areStores ? bench::PlanKind::ShadowPoints : bench::PlanKind::Frames;
    plan.methods = areStores ? findStores(arguments.shadows) : findMethods(arguments.methods);
    if (!arguments.size.empty()) plan.size = parseSize(arguments.size);
    plan.shadow = arguments.shadow;
    plan.settings = parseSettings(arguments.settings);
    plan.truth = arguments.truth;
    plan.count = areStores ? arguments.points : 0;
    std::vector<std::string> scenes = arguments.scenes;
    if (scenes.empty())
        scenes = areStores ? std::vector<std::string>{"shadow_panes", "shadow_discs"}
                           : std::vector<std::string>{"layers", "spheres_1k_48"};
    std::vector<bench::Plan> plans;
    for (const std::string& scene : scenes) {
        plan.scene = scene;
        plans.push_back(plan);
    }
    return plans;
}

void requireGpu(const gpu::DeviceInfo& device) {
    if (device.type != "cpu") return;
    std::string others;
    for (const gpu::DeviceInfo& info : gpu::listDevices())
        others += fmt::format("{}{} ({}{})", others.empty() ? "" : ", ", info.name, info.type,
                              info.rejections.empty() ? "" : ", unusable: " + info.rejections[0]);
    throw inputError(kDoing, "--gpu",
                     fmt::format("{} is a processor, allowed are devices of the types discrete, "
                                 "integrated and virtual; this machine has {}",
                                 device.name, others));
}

void runBench(const BenchArguments& arguments, const Log& log) {
    if (!arguments.compare.empty()) return compareRuns(arguments);
    // Wrong names before anything is opened.
    findSuites(arguments.suites);
    if (arguments.suites.empty())
        for (const bench::Plan& plan : makePlans(arguments))
            if (plan.kind != bench::PlanKind::Simulation) findScenes(plan.scene, log);
    const std::unique_ptr<gpu::Device> device = openDevice(arguments.device, log);
    if (arguments.onGpu) requireGpu(device->info());
    const bench::Results results = measure(arguments, *device, log);
    printResults(results);
    if (!arguments.json.empty()) bench::writeTextFile(arguments.json, bench::toJson(results));
    if (!arguments.report.empty()) bench::writeReport(arguments.report, results);
    checkValidation(*device, log);
    if (const auto failures = bench::listFailures(results); !failures.empty())
        throw failure(kDoing, "",
                      fmt::format("{} rows failed, the first: {}", failures.size(), failures[0]));
}

}  // namespace brume::app
