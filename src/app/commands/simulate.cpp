// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <app/commands/simulate.hpp>
#include <app/console.hpp>
#include <bench/report.hpp>
#include <chrono>
#include <core/error.hpp>
#include <particles/cpu_simulation.hpp>
#include <scene/loader.hpp>

namespace brume::app {
namespace {

constexpr int kMaxFrames = 1'000'000;
constexpr double kMaxSeconds = 1e6;

void checkArguments(const SimulateArguments& arguments) {
    if (arguments.frames < 1 || arguments.frames > kMaxFrames)
        throw inputError("reading options", fmt::format("--frames {}", arguments.frames),
                         fmt::format("not in 1..{}", kMaxFrames));
    if (!(arguments.secondsPerFrame > 0) ||
        !(arguments.secondsPerFrame * arguments.frames <= kMaxSeconds))
        throw inputError("reading options", fmt::format("--dt {}", arguments.secondsPerFrame),
                         fmt::format("not above 0 with at most {:g} s in all", kMaxSeconds));
}

bench::SimulationRow describe(const SimulateArguments& arguments) {
    bench::SimulationRow row;
    row.effect = arguments.effect.string();
    row.seed = arguments.seed;
    row.frames = arguments.frames;
    row.secondsPerFrame = arguments.secondsPerFrame;
    row.commit = bench::commit();
    return row;
}

void takeCounters(const particles::Counters& counters, bench::SimulationRow& row) {
    row.alive = counters.alive;
    row.born = counters.born;
    row.died = counters.died;
    row.rejected = counters.rejected;
}

bench::SimulationRow simulateOnCpu(const SimulateArguments& arguments,
                                   const scene::Effect& effect) {
    bench::SimulationRow row = describe(arguments);
    row.device = "CPU";
    particles::CpuSimulation simulation(effect, arguments.seed);
    std::vector<double> timesMs;
    Progress progress("simulating");
    for (int frame = 1; frame <= arguments.frames; ++frame) {
        const auto start = std::chrono::steady_clock::now();
        simulation.advanceTo(frame * arguments.secondsPerFrame);
        const std::chrono::duration<double, std::milli> time =
            std::chrono::steady_clock::now() - start;
        timesMs.push_back(time.count());
        progress.update(static_cast<double>(frame) / arguments.frames);
    }
    row.time = bench::summarise(timesMs);
    row.ticks = simulation.tick();
    row.hash = simulation.hash();
    takeCounters(simulation.counters(), row);
    return row;
}

}  // namespace

void runSimulate(const SimulateArguments& arguments, const Log& log) {
    checkArguments(arguments);
    const scene::Effect effect = scene::loadEffect(arguments.effect, log);
    const bench::SimulationRow row = simulateOnCpu(arguments, effect);
    fmt::print("{} of {:g} s on {}: alive {}, born {}, died {}, rejected {}, {:.3f} ms per frame\n",
               formatCount(static_cast<std::uint64_t>(row.frames), "frame"), row.secondsPerFrame,
               row.device, row.alive, row.born, row.died, row.rejected, row.time.median);
    if (arguments.hash) fmt::print("hash {:016x}\n", row.hash);
    if (!arguments.json.empty()) bench::writeTextFile(arguments.json, bench::toJson(row));
}

}  // namespace brume::app
