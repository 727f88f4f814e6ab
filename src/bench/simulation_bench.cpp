// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

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

class Bench {
  public:
    Bench(gpu::Device& device, int repeats)
        : mDevice(device), mSubmitter(device), mTimers(device), mRepeats(repeats) {}

    /// Median time of what `record` records, after one run that compiles its shaders.
    double measure(const std::function<void(gpu::Commands&)>& record) {
        std::vector<double> timesMs;
        for (int i = 0; i <= mRepeats; ++i) {
            mSubmitter.submitAndWait("bench", [&](gpu::Commands& commands) {
                mTimers.reset(commands);
                const std::size_t scope = mTimers.begin(commands, "bench");
                record(commands);
                mTimers.end(commands, scope);
            });
            if (i > 0) timesMs.push_back(mTimers.readTotalMs());
        }
        return summarise(timesMs).median;
    }

    double measureCopy(std::uint32_t particleCount) {
        const std::uint32_t count = particleCount * kBytesPerParticle / 16;
        gpu::Buffer source(mDevice, {.name = "bench.source", .bytes = count * 16ull});
        gpu::Buffer target(mDevice, {.name = "bench.target", .bytes = count * 16ull});
        const gpu::ComputePipeline copy(mDevice, {.name = "bench.copy",
                                                  .spirv = spv::bench_copy_comp,
                                                  .bindings = {{.number = 0}, {.number = 1}},
                                                  .pushConstantBytes = 4,
                                                  .specialization = {kWorkgroupSize}});
        mSubmitter.submitAndWait("fill", [&](gpu::Commands& commands) {
            commands.fillBuffer(source, 0x3f800000u);
            commands.computeTransferBarrier();
        });
        return measure([&](gpu::Commands& commands) {
            commands.bindCompute(copy);
            commands.bind(0, source);
            commands.bind(1, target);
            commands.pushConstants(count);
            commands.dispatchThreads(count, kWorkgroupSize);
            commands.computeBarrier();
        });
    }

    double measureTick(std::uint32_t particleCount,
                       const std::vector<scene::ModuleSettings>& modules,
                       std::uint32_t instanceCount = 1) {
        scene::Effect effect;
        effect.capacity = particleCount / instanceCount;
        effect.emitters = {{.bursts = {{0, effect.capacity}},
                            .shape = scene::EmitterShape::Sphere,
                            .radius = 5,
                            .speed = {0, 2},
                            .spread = kPi,
                            .lifetime = dvec2(1e6)}};
        effect.modules = modules;
        std::vector<particles::EffectInstance> instances;
        for (std::uint32_t i = 0; i < instanceCount; ++i) instances.push_back({1, i});
        particles::GpuSimulation simulation(mDevice, effect, instances);
        // The births, in a tick of their own.
        mSubmitter.submitAndWait("births", [&](gpu::Commands& commands) {
            simulation.recordTicks(commands, 1);
        });
        return measure([&](gpu::Commands& commands) { simulation.recordTicks(commands, 1); });
    }

    double measureSort(std::uint32_t count) {
        std::mt19937 random(1);
        std::vector<std::uint32_t> keys(count);
        for (std::uint32_t& key : keys) key = static_cast<std::uint32_t>(random());
        gpu::Buffer source(mDevice, {.name = "bench.unsorted",
                                     .bytes = count * 4ull,
                                     .memory = gpu::MemoryKind::Upload});
        std::memcpy(source.mapped(), keys.data(), count * 4ull);
        gpu::Buffer pairs(mDevice, {.name = "bench.pairs", .bytes = count * 8ull});
        const gpu::RadixSort sort(mDevice, "bench.sort", count);
        // Each run begins unsorted; the copy is taken off.
        const auto reset = [&](gpu::Commands& commands) {
            commands.copyBuffer(source, pairs, count * 4ull);
            commands.computeTransferBarrier();
        };
        const double copyMs = measure(reset);
        return measure([&](gpu::Commands& commands) {
                   reset(commands);
                   sort.record(commands, pairs.deviceAddress(),
                               pairs.deviceAddress() + count * 4ull, count);
                   commands.computeTransferBarrier();
               }) -
               copyMs;
    }

  private:
    gpu::Device& mDevice;
    gpu::Submitter mSubmitter;
    gpu::TimerPool mTimers;
    int mRepeats;
};

scene::ModuleSettings module(const char* type) { return {.type = type, .where = "bench"}; }

}  // namespace

std::vector<SimulationCost> measureSimulation(gpu::Device& device, std::uint32_t particleCount,
                                              int repeats) {
    Bench bench(device, repeats);
    const double copyMs = bench.measureCopy(particleCount);
    std::vector<SimulationCost> costs;
    const auto add = [&](const std::string& name, double timeMs) {
        costs.push_back({name, timeMs, timeMs / copyMs, 1e3 * particleCount / timeMs});
    };
    add("copy of 40 bytes each", copyMs);
    add("tick without modules", bench.measureTick(particleCount, {}));
    add("tick with gravity, drag",
        bench.measureTick(particleCount, {module("gravity"), module("drag")}));
    add("the same, 1 000 instances",
        bench.measureTick(particleCount, {module("gravity"), module("drag")}, 1000));
    add("tick with gravity, drag, curl_noise",
        bench.measureTick(particleCount,
                          {module("gravity"), module("drag"), module("curl_noise")}));
    add("radix sort of pairs", bench.measureSort(particleCount));
    return costs;
}

std::string formatTable(const std::vector<SimulationCost>& costs) {
    std::string text = fmt::format("| {:<38} | {:>10} | {:>8} | {:>10} |\n|---|---:|---:|---:|\n",
                                   "simulate", "ms", "x copy", "M/s");
    for (const SimulationCost& cost : costs)
        text += fmt::format("| {:<38} | {:>10.3f} | {:>8.2f} | {:>10.1f} |\n", cost.name,
                            cost.timeMs, cost.copyRatio, cost.perSecond * 1e-6);
    return text;
}

}  // namespace brume::bench
