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
#include <volumes/vdb_file.hpp>

#include <optional>

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

/// Adds those of one population.
void takeCounters(const particles::Counters& counters, bench::SimulationRow& row) {
    row.alive += counters.alive;
    row.born += counters.born;
    row.died += counters.died;
    row.rejected += counters.rejected;
    row.killed += counters.killed;
}

/// Calls advance(seconds) for every frame with the time at its end; it returns what it took in ms.
template <typename Advance>
bench::TimeSummary advanceFrames(const SimulateArguments& arguments, double startSeconds,
                                 const Advance& advance) {
    std::vector<double> timesMs;
    Progress progress("simulating");
    for (int frame = 1; frame <= arguments.frames; ++frame) {
        timesMs.push_back(advance(startSeconds + frame * arguments.secondsPerFrame));
        progress.update(static_cast<double>(frame) / arguments.frames);
    }
    return bench::summarise(timesMs);
}

/// The state to go on from, if one is asked for.
class Checkpoint {
  public:
    Checkpoint(const SimulateArguments& arguments, const scene::Effect& effect)
        : mPopulations(particles::compileEffect(effect)),
          mKey{particles::fingerprintOf(mPopulations), arguments.seed, 0} {
        if (!arguments.from.empty())
            mStart = particles::readCheckpoint(arguments.from, mKey, mPopulations);
    }

    const std::optional<particles::SimulationState>& start() const { return mStart; }
    double startSeconds() const {
        return mStart ? static_cast<double>(mStart->tick) / mPopulations[0].tickRate : 0;
    }
    void write(const std::filesystem::path& file, const particles::SimulationState& state) const {
        if (!file.empty()) particles::writeCheckpoint(file, mKey, state);
    }

  private:
    std::vector<particles::CompiledEffect> mPopulations;
    particles::CheckpointKey mKey;
    std::optional<particles::SimulationState> mStart;
};

void takeState(const particles::SimulationState& state, bench::SimulationRow& row) {
    row.ticks = state.tick;
    row.hash = state.hash();
    for (const particles::Counters& counters : state.counters) takeCounters(counters, row);
}

bench::SimulationRow simulateOnCpu(const SimulateArguments& arguments, const scene::Effect& effect,
                                   const Checkpoint& checkpoint) {
    bench::SimulationRow row = describe(arguments);
    row.device = "CPU";
    particles::CpuSimulation simulation(effect, arguments.seed);
    if (checkpoint.start()) simulation.restore(*checkpoint.start());
    row.time = advanceFrames(arguments, checkpoint.startSeconds(), [&](double seconds) {
        const auto start = std::chrono::steady_clock::now();
        simulation.advanceTo(seconds);
        const auto end = std::chrono::steady_clock::now();
        return std::chrono::duration<double, std::milli>(end - start).count();
    });
    takeState(simulation.state(), row);
    checkpoint.write(arguments.checkpoint, simulation.state());
    return row;
}

bench::SimulationRow simulateOnDevice(const SimulateArguments& arguments,
                                      const scene::Effect& effect, const Checkpoint& checkpoint,
                                      const Log& log) {
    const std::unique_ptr<gpu::Device> device = openDevice(arguments.device, log);
    bench::SimulationRow row = describe(arguments);
    row.device = device->info().name;
    row.driver = device->info().driver;
    {
        gpu::Submitter submitter(*device);
        gpu::TimerPool timers(*device);
        particles::GpuSimulation simulation(*device, effect, arguments.seed);
        if (checkpoint.start()) simulation.writeState(submitter, {&*checkpoint.start(), 1});
        row.time = advanceFrames(arguments, checkpoint.startSeconds(), [&](double seconds) {
            submitter.submitAndWait("simulate", [&](gpu::Commands& commands) {
                timers.reset(commands);
                const std::size_t scope = timers.begin(commands, "particles.simulate");
                simulation.recordAdvanceTo(commands, seconds);
                timers.end(commands, scope);
            });
            return timers.readTotalMs();
        });
        const particles::SimulationState state = simulation.readState(submitter);
        takeState(state, row);
        checkpoint.write(arguments.checkpoint, state);
    }
    checkValidation(*device, log);
    return row;
}

}  // namespace

void runSimulate(const SimulateArguments& arguments, const Log& log) {
    checkArguments(arguments);
    scene::Effect effect = scene::loadEffect(arguments.effect, log);
    volumes::loadEffectFields(effect);
    particles::requireReplayable(particles::compileEffect(effect), "simulating");
    const Checkpoint checkpoint(arguments, effect);
    const bench::SimulationRow row = arguments.reference
                                         ? simulateOnCpu(arguments, effect, checkpoint)
                                         : simulateOnDevice(arguments, effect, checkpoint, log);
    fmt::print("{} of {:g} s on {}: alive {}, born {}, died {}, rejected {}, not finite {}, {:.3f} ms per "
               "frame\n",
               formatCount(static_cast<std::uint64_t>(row.frames), "frame"), row.secondsPerFrame,
               row.device, row.alive, row.born, row.died, row.rejected, row.killed, row.time.median);
    if (row.rejected > 0)
        log.warning(fmt::format("simulating: {} of {} births found no room; 'capacity' is used up",
                                row.rejected, row.born + row.rejected));
    if (arguments.hash) fmt::print("hash {:016x}\n", row.hash);
    if (!arguments.json.empty()) bench::writeTextFile(arguments.json, bench::toJson(row));
}

}  // namespace brume::app
