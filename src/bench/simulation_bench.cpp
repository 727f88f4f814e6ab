// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include <bench/simulation_bench.hpp>
#include <bench/statistics.hpp>
#include <functional>
#include <gpu/radix_sort.hpp>
#include <gpu/submitter.hpp>
#include <gpu/timer_pool.hpp>
#include <particles/gpu_simulation.hpp>
#include <random>
#include <spv/bench/copy.comp.hpp>

namespace brume::bench {
namespace {

constexpr std::uint32_t kBytesPerParticle = 40;
constexpr std::uint32_t kWorkgroupSize = 64;

/// Something to be measured: `prepare` is not part of the time.
struct Case {
    std::string name;
    std::function<void(gpu::Commands&)> prepare, record;
    std::vector<double> timesMs;
    std::vector<std::string> passes;  ///< if not empty, only their times count
};

/// All cases in turn, round by round, so that a machine that is busy with something else slows them
/// all alike.
class Bench {
  public:
    explicit Bench(gpu::Device& device) : mDevice(device), mSubmitter(device), mTimers(device) {}

    gpu::Device& device() { return mDevice; }
    gpu::TimerPool& timers() { return mTimers; }

    void submit(const std::function<void(gpu::Commands&)>& record) {
        mSubmitter.submitAndWait("bench", record);
    }

    double timeMs(const std::function<void(gpu::Commands&)>& record) {
        submit([&](gpu::Commands& commands) {
            mTimers.reset(commands);
            const std::size_t scope = mTimers.begin(commands, "bench");
            record(commands);
            mTimers.end(commands, scope);
        });
        return mTimers.readTotalMs();
    }

    double readPassesMs(const std::vector<std::string>& passes) const {
        double sum = 0;
        for (const gpu::ScopeTime& scope : mTimers.read())
            if (std::find(passes.begin(), passes.end(), scope.name) != passes.end())
                sum += scope.timeMs;
        return sum;
    }

    /// The first round compiles the shaders and does not count.
    void measure(std::vector<Case>& cases, int repeats) {
        for (int round = 0; round <= repeats; ++round)
            for (Case& one : cases) {
                if (one.prepare) submit(one.prepare);
                double ms = timeMs(one.record);
                if (!one.passes.empty()) ms = readPassesMs(one.passes);
                if (round > 0) one.timesMs.push_back(ms);
            }
    }

  private:
    gpu::Device& mDevice;
    gpu::Submitter mSubmitter;
    gpu::TimerPool mTimers;
};

/// The yardstick: as many bytes as the hot states of the particles, by one vec4 per invocation.
Case makeCopy(Bench& bench, std::uint32_t particleCount) {
    const std::uint32_t count = particleCount * kBytesPerParticle / 16;
    struct Buffers {
        gpu::Buffer source, target;
        gpu::ComputePipeline copy;
    };
    const auto make = [&](const char* name) {
        return gpu::Buffer(bench.device(), {.name = name, .bytes = count * 16ull});
    };
    const auto buffers = std::make_shared<Buffers>(
        Buffers{make("bench.source"), make("bench.target"),
                gpu::ComputePipeline(bench.device(), {.name = "bench.copy",
                                                      .spirv = spv::bench_copy_comp,
                                                      .bindings = {{.number = 0}, {.number = 1}},
                                                      .pushConstantBytes = 4,
                                                      .specialization = {kWorkgroupSize}})});
    bench.submit([&](gpu::Commands& commands) {
        commands.fillBuffer(buffers->source, 0x3f800000u);
        commands.computeTransferBarrier();
    });
    const auto record = [=](gpu::Commands& commands) {
        commands.bindCompute(buffers->copy);
        commands.bind(0, buffers->source);
        commands.bind(1, buffers->target);
        commands.pushConstants(count);
        commands.dispatchThreads(count, kWorkgroupSize);
        commands.computeBarrier();
    };
    return {"copy of 40 bytes each", {}, record, {}, {}};
}

scene::Effect makeBurst(std::uint32_t particleCount, const dvec2& lifetime,
                        std::vector<scene::ModuleSettings> modules) {
    scene::Effect effect;
    effect.capacity = particleCount;
    effect.emitters = {{.bursts = {{0, particleCount}},
                        .shape = scene::EmitterShape::Sphere,
                        .radius = 5,
                        .speed = {0, 2},
                        .spread = kPi,
                        .lifetime = lifetime}};
    effect.modules = std::move(modules);
    return effect;
}

/// A tick of particles that all live on, equally many in each instance.
Case makeTick(Bench& bench, const std::string& name, std::uint32_t particleCount,
              std::vector<scene::ModuleSettings> modules, std::uint32_t instanceCount = 1) {
    std::vector<particles::EffectInstance> instances;
    for (std::uint32_t i = 0; i < instanceCount; ++i) instances.push_back({1, i, {}});
    const auto simulation = std::make_shared<particles::GpuSimulation>(
        bench.device(),
        makeBurst(particleCount / instanceCount, dvec2(1e6), std::move(modules)), instances);
    // The births, in a tick of their own.
    bench.submit([&](gpu::Commands& commands) { simulation->recordTicks(commands, 1); });
    return {
        name, {}, [=](gpu::Commands& commands) { simulation->recordTicks(commands, 1); }, {}, {}};
}

/// A tick in which half of them die: the rest closes up, in order.
Case makeDeaths(Bench& bench, const std::string& name, std::uint32_t particleCount,
                std::vector<std::string> passes = {}) {
    const scene::Effect effect = makeBurst(particleCount, dvec2(1, 3) / 120.0, {});
    particles::GpuSimulationOptions options;
    if (!passes.empty()) options.timers = &bench.timers();
    const auto simulation =
        std::make_shared<particles::GpuSimulation>(bench.device(), effect, 1, 0, options);
    const auto tick = [=](gpu::Commands& commands) { simulation->recordTicks(commands, 1); };
    const auto prepare = [=](gpu::Commands& commands) {
        simulation->recordAdvanceTo(commands, 0);  // anew
        tick(commands);
    };
    return {name, prepare, tick, {}, std::move(passes)};
}

Case makeSort(Bench& bench, std::uint32_t count) {
    std::mt19937 random(1);
    std::vector<std::uint32_t> keys(count);
    for (std::uint32_t& key : keys) key = static_cast<std::uint32_t>(random());
    struct Buffers {
        gpu::Buffer source, keys, values;
        gpu::RadixSort sort;
    };
    const auto buffers = std::make_shared<Buffers>(Buffers{
        gpu::Buffer(
            bench.device(),
            {.name = "bench.unsorted", .bytes = count * 4ull, .memory = gpu::MemoryKind::Upload}),
        gpu::Buffer(bench.device(), {.name = "bench.keys", .bytes = count * 4ull}),
        gpu::Buffer(bench.device(), {.name = "bench.values", .bytes = count * 4ull}),
        gpu::RadixSort(bench.device(), "bench.sort", count)});
    std::memcpy(buffers->source.mapped(), keys.data(), count * 4ull);
    const auto prepare = [=](gpu::Commands& commands) {  // each run begins unsorted
        commands.copyBuffer(buffers->source, buffers->keys, count * 4ull);
        commands.computeTransferBarrier();
    };
    const auto record = [=](gpu::Commands& commands) {
        buffers->sort.record(commands, buffers->keys, buffers->values, count);
        commands.computeTransferBarrier();
    };
    return {"radix sort of pairs", prepare, record, {}, {}};
}

scene::ModuleSettings module(const char* type) { return {.type = type, .where = "bench"}; }

}  // namespace

std::vector<SimulationCost> measureSimulation(gpu::Device& device, std::uint32_t particleCount,
                                              int repeats) {
    Bench bench(device);
    std::vector<Case> cases;
    cases.push_back(makeCopy(bench, particleCount));
    cases.push_back(makeTick(bench, "tick without modules", particleCount, {}));
    cases.push_back(makeTick(bench, "tick with gravity, drag", particleCount,
                             {module("gravity"), module("drag")}));
    cases.push_back(makeTick(bench, "the same, 1 000 instances", particleCount,
                             {module("gravity"), module("drag")}, 1000));
    cases.push_back(makeTick(bench, "tick with gravity, drag, curl_noise", particleCount,
                             {module("gravity"), module("drag"), module("curl_noise")}));
    cases.push_back(makeDeaths(bench, "tick in which half of them die", particleCount));
    cases.push_back(makeDeaths(bench, "its stable compaction alone", particleCount,
                               {"particles.count", "particles.offsets", "particles.totals"}));
    cases.push_back(makeSort(bench, particleCount));
    bench.measure(cases, repeats);

    std::vector<SimulationCost> costs;
    for (const Case& one : cases) {
        std::vector<double> ratios;
        for (std::size_t i = 0; i < one.timesMs.size(); ++i)
            ratios.push_back(one.timesMs[i] / cases[0].timesMs[i]);
        const TimeSummary time = summarise(one.timesMs);
        costs.push_back({one.name, time, summarise(ratios).median,
                         1e3 * particleCount / time.median,
                         fmt::format("brume bench --scenes simulate --particles {} --repeats {}",
                                     particleCount, repeats)});
    }
    return costs;
}

Table makeSimulationTable(std::span<const SimulationCost> costs) {
    Table table{.title = "Particle simulator",
                .header = {"simulate", "ms", "p05..p95", "x copy", "M/s"}};
    for (const SimulationCost& cost : costs)
        table.rows.push_back({cost.name, fmt::format("{:.3f}", cost.time.median),
                              fmt::format("{:.3f}..{:.3f}", cost.time.p05, cost.time.p95),
                              fmt::format("{:.2f}", cost.copyRatio),
                              fmt::format("{:.1f}", cost.perSecond * 1e-6)});
    return table;
}

}  // namespace brume::bench
