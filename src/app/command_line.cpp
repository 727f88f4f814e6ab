// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <app/command_line.hpp>
#include <app/commands/bench.hpp>
#include <app/commands/compare.hpp>
#include <app/commands/inspect.hpp>
#include <app/commands/list.hpp>
#include <app/commands/render.hpp>
#include <app/commands/simulate.hpp>
#include <app/commands/view.hpp>
#include <app/console.hpp>
#include <bench/row.hpp>
#include <core/error.hpp>
#include <exception>
#include <functional>
#include <new>

namespace brume::app {
namespace {

enum ExitCode { kDone = 0, kFailed = 1, kWrongUsage = 2 };

/// The arguments of all commands, and the one that was chosen.
struct Invocation {
    bool verbose = false;
    RenderArguments render;
    CompareArguments compare;
    BenchArguments bench;
    SimulateArguments simulate;
    InspectArguments inspect;
    ListArguments list;
    ViewArguments view;
    std::function<void(const Log&)> command;
};

void addDeviceOptions(CLI::App& command, DeviceArguments& arguments) {
    command.add_option("--device", arguments.device,
                       "Vulkan device: part of its name, or its index in `brume list devices`");
    command.add_flag("--validate", arguments.validate,
                     "Run under the validation layers; fail on any message");
}

void addRender(CLI::App& app, Invocation& invocation) {
    RenderArguments& a = invocation.render;
    CLI::App* command = app.add_subcommand("render", "Render a scene file");
    command->add_option("scene", a.scene, "Scene file (.json)")->required();
    command->add_option(
        "-o,--output", a.output,
        "Image file, .exr (linear) or .png (sRGB); #### stands for the frame number");
    command->add_option("--method", a.method, "Method of `brume list methods`, or reference");
    command->add_option("--shadow", a.shadow, "Shadow store of all lights, or none");
    command->add_option("--size", a.size, "WIDTHxHEIGHT in pixels");
    auto* frame = command->add_option("--frame", a.frame, "Effects at this frame's time");
    command->add_option("--frames", a.frames, "Frames FIRST:LAST, both included")->excludes(frame);
    command->add_option("--shard", a.shard,
                        "I/N: only the I-th of N parts of the frames; 0/N: write the checkpoints "
                        "that the parts start from");
    command->add_option("--checkpoints", a.checkpoints,
                        "Folder of simulation states to start from, written by --shard 0/N");
    command->add_flag("--resume", a.resume, "Leave out frames whose files are there already");
    command->add_option("--frame-rate", a.frameRate, "Frames per second of --frame and --frames")
        ->check(CLI::Range(1e-3, 1e6))
        ->capture_default_str();
    command->add_option("--seed", a.seed, "Seed of the first effect; the others count on from it");
    command
        ->add_option("--particle-budget", a.particleBudget,
                     "Capacity of all effects together, instead of the scene's")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000'000}));
    command->add_option("--set", a.settings, "Setting of the method, key=value")
        ->allow_extra_args(false);
    command->add_option("--against", a.against,
                        "Print the error against `reference` or an image file");
    command->add_flag("--explain", a.explain,
                      "Print what the scene needs and what follows from it");
    command
        ->add_option("--repeats", a.repeats, "Frames to measure, after one to warm up if several")
        ->check(CLI::Range(1, 100000));
    command->add_option("--json", a.json, "Write the measurement to this file");
    addDeviceOptions(*command, a.device);
    command->callback(
        [&] { invocation.command = [&](const Log& log) { runRender(invocation.render, log); }; });
}

void addCompare(CLI::App& app, Invocation& invocation) {
    CompareArguments& a = invocation.compare;
    CLI::App* command = app.add_subcommand("compare", "Measure the difference of two images");
    command->add_option("test", a.test, "Image file")->required();
    command->add_option("reference", a.reference, "Image file that is taken for right")->required();
    command->add_option("--json", a.json, "Write the figures to this file");
    command->add_option("--diff", a.diff,
                        "Write a picture of the absolute differences (black 1e-6 to white 1)");
    command->callback(
        [&] { invocation.command = [&](const Log& log) { runCompare(invocation.compare, log); }; });
}

void addBench(CLI::App& app, Invocation& invocation) {
    BenchArguments& a = invocation.bench;
    CLI::App* command = app.add_subcommand("bench", "Measure time, bytes and error of methods");
    command->add_option("--scenes", a.scenes, "Names of `brume list scenes`, scene files, or `simulate`")
        ->delimiter(',');
    command->add_option("--methods", a.methods, "Names of `brume list methods`, or all; name:key=value:... for one with settings")
        ->delimiter(',');
    command->add_option("--shadows", a.shadows, "Measure these shadow stores at points, or all")->delimiter(',');
    command->add_option("--suite", a.suites, "Named suites of rows (see docs/performance.md), or all")
        ->delimiter(',');
    command->add_flag("--gpu", a.onGpu, "Fail unless the device is a GPU, instead of measuring a processor");
    command->add_flag("--quick", a.isQuick, "Suites at small sizes: minutes on two cores");
    command->add_option("--shadow", a.shadow, "Shadow store of all lights, or none");
    command->add_option("--truth", a.truth, "Scene whose reference errors are against");
    command->add_option("--compare", a.compare, "OLD.json NEW.json: what changed beyond noise; exit code 1 if for the worse")
        ->expected(2);
    command->add_option("--threshold", a.threshold, "Growth of time, error or bytes that counts")
        ->check(CLI::Range(0.0, 1e3))
        ->capture_default_str();
    command->add_option("--points", a.points, "Points of --shadows")
        ->check(CLI::Range(1, 1'000'000))
        ->capture_default_str();
    command->add_option("--particles", a.particles, "Particles of --scenes simulate")
        ->check(CLI::Range(1, 10'000'000))
        ->capture_default_str();
    command->add_option("--size", a.size, "WIDTHxHEIGHT in pixels instead of the scenes' own");
    command->add_option("--repeats", a.repeats, "Frames to measure per row (default 20; quick suites 5, short ones up to 20)")
        ->check(CLI::Range(1, 100000));
    command->add_flag("!--no-error", a.withError, "Do not compare with the reference");
    command->add_option("--error-every", a.errorEvery, "Compare only the middle one of each N x N pixels, where the reference takes long")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    command->add_option("--set", a.settings, "Setting of the methods that know it, key=value")
        ->allow_extra_args(false);
    command->add_option("--json", a.json, "Write the rows to this file");
    command->add_option("--report", a.report, "Write a page with plots and pictures into this folder");
    addDeviceOptions(*command, a.device);
    command->callback(
        [&] { invocation.command = [&](const Log& log) { runBench(invocation.bench, log); }; });
}

void addSimulate(CLI::App& app, Invocation& invocation) {
    SimulateArguments& a = invocation.simulate;
    CLI::App* command = app.add_subcommand("simulate", "Run an effect without rendering it");
    command->add_option("effect", a.effect, "Effect file (.json)")->required();
    command->add_option("--frames", a.frames, "Frames to simulate")->capture_default_str();
    command->add_option("--from", a.from, "Go on from a file written by --checkpoint");
    command->add_option("--checkpoint", a.checkpoint, "Write the state after the frames to a file");
    command->add_option("--dt", a.secondsPerFrame, "Seconds per frame (default 1/24)");
    command->add_option("--seed", a.seed, "Seed of the random numbers")->capture_default_str();
    command->add_flag("--hash", a.hash, "Print a hash of the particles");
    command->add_flag("--reference", a.reference, "Simulate on the CPU");
    command->add_option("--json", a.json, "Write the counts to this file");
    addDeviceOptions(*command, a.device);
    command->callback([&] {
        invocation.command = [&](const Log& log) { runSimulate(invocation.simulate, log); };
    });
}

void addInspect(CLI::App& app, Invocation& invocation) {
    CLI::App* command =
        app.add_subcommand("inspect", "Show what is in a volume, scene or effect file");
    command->add_option("file", invocation.inspect.file, "File (.vdb, .nvdb or .json)")->required();
    command->callback(
        [&] { invocation.command = [&](const Log& log) { runInspect(invocation.inspect, log); }; });
}

void addList(CLI::App& app, Invocation& invocation) {
    ListArguments& a = invocation.list;
    CLI::App* command = app.add_subcommand("list", "Show what there is to choose from");
    command->add_option("what", a.what, "methods, shadows, modules, devices or scenes")
        ->required()
        ->check(CLI::IsMember({"methods", "shadows", "modules", "devices", "scenes"}));
    command->add_flag("--markdown", a.markdown, "Methods as the table of the README, modules as that of docs/particles.md");
    command->callback(
        [&] { invocation.command = [&](const Log& log) { runList(invocation.list, log); }; });
}

void addView(CLI::App& app, Invocation& invocation) {
    ViewArguments& a = invocation.view;
    CLI::App* command = app.add_subcommand("view", "Show a scene in a window");
    command->add_option("scene", a.scene, "Scene file (.json)")->required();
    command->add_option("--method", a.method, "Method of `brume list methods`");
    command->add_option("--shadow", a.shadow, "Shadow store of all lights, or none");
    command->add_option("--set", a.settings, "Setting of the method, key=value")
        ->allow_extra_args(false);
    command->add_option("--size", a.size, "WIDTHxHEIGHT of the window (default 1280x720)");
    command->add_option("--shaders", a.shaders,
                        "Compile and use the shaders of this folder when they change");
    command->add_option("--script", a.script, "Do what this file says, see docs/viewer.md");
    command->add_flag("--offscreen", a.isOffscreen, "Open no window; for scripts");
    addDeviceOptions(*command, a.device);
    command->callback(
        [&] { invocation.command = [&](const Log& log) { runView(invocation.view, log); }; });
}

/// Parses into `invocation`; the exit code if that is already the end (help, version, wrong usage).
std::optional<int> parse(int argc, char** argv, Invocation& invocation) {
    CLI::App app("Particle and volumetric effects with exact transparency", "brume");
    app.set_version_flag("--version",
                         fmt::format("brume {} ({})", bench::version(), bench::commit()));
    app.add_flag("--verbose", invocation.verbose, "Say more about what is being done");
    app.require_subcommand(1);
    app.fallthrough();
    addRender(app, invocation);
    addCompare(app, invocation);
    addBench(app, invocation);
    addSimulate(app, invocation);
    addInspect(app, invocation);
    addList(app, invocation);
    addView(app, invocation);
    for (int i = 0; i < argc; ++i)
        invocation.bench.command += (i ? " " : "") + bench::quoteForShell(i ? argv[i] : "brume");
    try {
        app.parse(argc, argv);
        return std::nullopt;
    } catch (const CLI::Success& success) {
        return app.exit(success);
    } catch (const CLI::ParseError& error) {
        printError(fmt::format("reading options: {}, see brume --help", error.what()));
        return kWrongUsage;
    }
}

int runGuarded(const Invocation& invocation) {
    try {
        invocation.command(makeConsoleLog(invocation.verbose));
        return kDone;
    } catch (const Error& error) {
        printError(error.what());
        return error.kind() == ErrorKind::Input ? kWrongUsage : kFailed;
    } catch (const std::bad_alloc&) {
        printError("out of memory");
    } catch (const std::exception& error) {
        printError(fmt::format("internal error: {}", error.what()));
    }
    return kFailed;
}

}  // namespace

BenchArguments parseBenchCommand(std::vector<std::string> words) {
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    Invocation invocation;
    if (words.size() < 2 || words[1] != "bench" ||
        parse(static_cast<int>(argv.size()), argv.data(), invocation))
        throw inputError("reading options", words.empty() ? "" : words[0], "not a bench command");
    return invocation.bench;
}

int run(int argc, char** argv) {
    Invocation invocation;
    if (const std::optional<int> code = parse(argc, argv, invocation)) return *code;
    return runGuarded(invocation);
}

}  // namespace brume::app
