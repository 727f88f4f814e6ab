// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <app/commands/simulate.hpp>
#include <app/console.hpp>
#include <bench/report.hpp>
#include <chrono>
#include <core/error.hpp>
#include <gpu/submitter.hpp>
#include <gpu/timer_pool.hpp>
#include <particles/cpu_simulation.hpp>
#include <particles/gpu_simulation.hpp>
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

double secondsAfter(const SimulateArguments& arguments, int frame) {
    return frame * arguments.secondsPerFrame;
}

/// Calls advance(frame) for every frame; it returns the frame's time in ms.
template <typename Advance>
bench::TimeSummary advanceFrames(const SimulateArguments& arguments, const Advance& advance) {
    std::vector<double> timesMs;
    Progress progress("simulating");
    for (int frame = 1; frame <= arguments.frames; ++frame) {
        timesMs.push_back(advance(frame));
        progress.update(static_cast<double>(frame) / arguments.frames);
    }
    return bench::summarise(timesMs);
}

bench::SimulationRow simulateOnCpu(const SimulateArguments& arguments,
                                   const scene::Effect& effect) {
    bench::SimulationRow row = describe(arguments);
    row.device = "CPU";
    particles::CpuSimulation simulation(effect, arguments.seed);
    row.time = advanceFrames(arguments, [&](int frame) {
        const auto start = std::chrono::steady_clock::now();
        simulation.advanceTo(secondsAfter(arguments, frame));
        const auto end = std::chrono::steady_clock::now();
        return std::chrono::duration<double, std::milli>(end - start).count();
    });
    row.ticks = simulation.tick();
    row.hash = simulation.hash();
    takeCounters(simulation.counters(), row);
    return row;
}

bench::SimulationRow simulateOnDevice(const SimulateArguments& arguments,
                                      const scene::Effect& effect, const Log& log) {
    const std::unique_ptr<gpu::Device> device = openDevice(arguments.device, log);
    bench::SimulationRow row = describe(arguments);
    row.device = device->info().name;
    row.driver = device->info().driver;
    {
        gpu::Submitter submitter(*device);
        gpu::TimerPool timers(*device);
        particles::GpuSimulation simulation(*device, effect, arguments.seed);
        row.time = advanceFrames(arguments, [&](int frame) {
            submitter.submitAndWait("simulate", [&](gpu::Commands& commands) {
                timers.reset(commands);
                const std::size_t scope = timers.begin(commands, "particles.simulate");
                simulation.recordAdvanceTo(commands, secondsAfter(arguments, frame));
                timers.end(commands, scope);
            });
            return timers.readTotalMs();
        });
        const particles::GpuSimulation::Snapshot state = simulation.readState(submitter);
        row.ticks = state.tick;
        row.hash = state.hash();
        takeCounters(state.counters, row);
    }
    checkValidation(*device, log);
    return row;
}

}  // namespace

void runSimulate(const SimulateArguments& arguments, const Log& log) {
    checkArguments(arguments);
    const scene::Effect effect = scene::loadEffect(arguments.effect, log);
    const bench::SimulationRow row = arguments.reference ? simulateOnCpu(arguments, effect)
                                                         : simulateOnDevice(arguments, effect, log);
    fmt::print("{} of {:g} s on {}: alive {}, born {}, died {}, rejected {}, {:.3f} ms per frame\n",
               formatCount(static_cast<std::uint64_t>(row.frames), "frame"), row.secondsPerFrame,
               row.device, row.alive, row.born, row.died, row.rejected, row.time.median);
    if (arguments.hash) fmt::print("hash {:016x}\n", row.hash);
    if (!arguments.json.empty()) bench::writeTextFile(arguments.json, bench::toJson(row));
}

}  // namespace brume::app
