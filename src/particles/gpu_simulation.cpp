// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <core/assert.hpp>
#include <core/error.hpp>
#include <particles/gpu_simulation.hpp>
#include <spv/particles/appearance.comp.hpp>
#include <spv/particles/count.comp.hpp>
#include <spv/particles/offsets.comp.hpp>
#include <spv/particles/step.comp.hpp>
#include <spv/particles/totals.comp.hpp>

#include <algorithm>
#include <cstring>
#include <numeric>

namespace brume::particles {
namespace {

std::uint32_t divideUp(std::uint64_t a, std::uint64_t b) {
    return static_cast<std::uint32_t>((a + b - 1) / b);
}

/// Software devices like long serial runs as long as there are enough for their threads and lanes,
/// GPUs like many threads; chosen by us from measurements.
std::uint32_t defaultChunkSize(const gpu::Device& device, std::uint32_t capacity) {
    return device.isLavapipe() ? std::clamp(capacity / 512, 16u, 512u) : 16;
}

/// Ticks whose parameters are uploaded at once; chosen by us, a second or more of most effects.
constexpr std::uint32_t kTicksPerPart = 256;

/// Writes an array by way of the command buffer, which takes 64 KiB at a time.
template <typename T>
void updateArray(gpu::Commands& commands, const gpu::Buffer& buffer, const std::vector<T>& values) {
    constexpr std::size_t kPerUpdate = 65536 / sizeof(T);
    for (std::size_t first = 0; first < values.size(); first += kPerUpdate) {
        const std::size_t count = std::min(kPerUpdate, values.size() - first);
        commands.updateBuffer(buffer, &values[first], count * sizeof(T), first * sizeof(T));
    }
}

template <typename T>
gpu::Buffer makeFilledBuffer(gpu::Device& device, const std::string& name,
                             std::span<const T> values) {
    gpu::Buffer buffer(device, {.name = name,
                                .bytes = std::max<std::uint64_t>(values.size_bytes(), 4),
                                .memory = gpu::MemoryKind::Upload});
    if (!values.empty()) std::memcpy(buffer.mapped(), values.data(), values.size_bytes());
    return buffer;
}

}  // namespace

GpuSimulation::GpuSimulation(gpu::Device& device, const scene::Effect& effect, std::uint64_t seed,
                             std::uint32_t instance, const GpuSimulationOptions& options)
    : mEffect(compileEffect(effect, seed, instance)),
      mSchedule(mEffect.schedule),
      mAliveBound(mEffect.aliveBound),
      mWorkgroupSize(options.workgroupSize),
      mChunkSize(options.chunkSize ? options.chunkSize
                                   : defaultChunkSize(device, mEffect.capacity)) {
    // Beyond that an invocation may exceed the iterations that a software device grants it.
    BRUME_ASSERT_LE(mChunkSize, 4096u);
    makeBuffers(device);
    makePipelines(device);
}

void GpuSimulation::makeBuffers(gpu::Device& device) {
    const std::uint64_t capacity = mEffect.capacity;
    // Existing particles and births each have up to this many chunks.
    const std::uint64_t chunks = divideUp(capacity, mChunkSize);
    const std::uint64_t groups = divideUp(chunks, shader::kChunksPerGroup);
    constexpr std::uint32_t kUsualBatches = 2048;
    mBatchCapacity = std::max(kUsualBatches, mSchedule.maxBatchesPerTick());

    if (capacity * sizeof(vec3) > device.limits().maxStorageBufferRange)
        throw inputError(
            "setting up an effect", "",
            fmt::format("'capacity' is {}, at most {} allowed on this device", capacity,
                        device.limits().maxStorageBufferRange / sizeof(vec3)));
    for (int i = 0; i < 2; ++i)
        mStates[i] = gpu::Buffer(device, {.name = i == 0 ? "particles.stateA" : "particles.stateB",
                                          .bytes = stateOffsets()[4]});
    mBatches = gpu::Buffer(device, {.name = "particles.batches",
                                    .bytes = mBatchCapacity * sizeof(shader::BirthBatch)});
    mTicks = gpu::Buffer(
        device, {.name = "particles.ticks", .bytes = kTicksPerPart * sizeof(shader::Tick)});
    mChunks = gpu::Buffer(device, {.name = "particles.chunks", .bytes = 2 * chunks * 4});
    mGroups = gpu::Buffer(device, {.name = "particles.groups", .bytes = 2 * groups * 4});
    mTotals =
        gpu::Buffer(device, {.name = "particles.totals", .bytes = sizeof(shader::TickTotals)});
    mParameters = makeFilledBuffer<shader::EffectParameters>(device, "particles.parameters",
                                                             {&mEffect.parameters, 1});
    mEmitters =
        makeFilledBuffer<shader::EmitterParameters>(device, "particles.emitters", mEffect.emitters);
}

void GpuSimulation::makePipelines(gpu::Device& device) {
    namespace sh = shader;
    using Numbers = std::vector<std::uint32_t>;
    const auto make = [&](const char* name, std::span<const std::uint32_t> spirv,
                          const Numbers& bindings, std::size_t pushBytes) {
        gpu::ComputePipelineDesc desc;
        desc.name = name;
        desc.spirv = spirv;
        for (const std::uint32_t number : bindings) desc.bindings.push_back({.number = number});
        desc.pushConstantBytes = static_cast<std::uint32_t>(pushBytes);
        desc.specialization = {mWorkgroupSize, mEffect.parameters.curlNoiseCount};
        return gpu::ComputePipeline(device, desc);
    };
    constexpr std::size_t kTickBytes = sizeof(sh::TickPush);
    mCount = make("particles.count", spv::particles_count_comp,
                  {sh::kBindingEffect, sh::kBindingLives, sh::kBindingChunks, sh::kBindingTotals,
                   sh::kBindingEmitters, sh::kBindingBatches, sh::kBindingTicks},
                  kTickBytes);
    mOffsets = make("particles.offsets", spv::particles_offsets_comp,
                    {sh::kBindingChunks, sh::kBindingGroups, sh::kBindingTicks}, kTickBytes);
    mTotalsPass = make("particles.totals", spv::particles_totals_comp,
                       {sh::kBindingGroups, sh::kBindingTotals, sh::kBindingTicks}, kTickBytes);
    Numbers all(sh::kBindingTicks + 1);
    std::iota(all.begin(), all.end(), 0u);
    mStep = make("particles.step", spv::particles_step_comp, all, kTickBytes);
    mAppearance = make("particles.appearance", spv::particles_appearance_comp,
                       {sh::kBindingEffect, sh::kBindingPositions, sh::kBindingLives,
                        sh::kBindingBirthIndices, sh::kBindingTotals, sh::kBindingParticleSpheres},
                       sizeof(sh::AppearancePush));
}

std::array<std::uint64_t, 5> GpuSimulation::stateOffsets() const {
    constexpr std::array<std::uint64_t, 4> kSizes = {
        sizeof(vec3), sizeof(vec3), sizeof(shader::ParticleLife), sizeof(std::uint32_t)};
    std::array<std::uint64_t, 5> offsets{};
    // Bindings begin at multiples of 256 bytes.
    for (std::size_t i = 0; i < kSizes.size(); ++i)
        offsets[i + 1] = offsets[i] + (kSizes[i] * mEffect.capacity + 255) / 256 * 256;
    return offsets;
}

gpu::BufferRange GpuSimulation::stateRange(std::uint32_t state, std::uint32_t field) const {
    const auto offsets = stateOffsets();
    return {&mStates[state], offsets[field], offsets[field + 1] - offsets[field]};
}

void GpuSimulation::bindForTick(gpu::Commands& commands,
                                const gpu::ComputePipeline& pipeline) const {
    commands.bindCompute(pipeline);
    for (const gpu::Binding& binding : pipeline.bindings()) {
        const std::uint32_t number = binding.number;
        switch (number) {
            case shader::kBindingEffect:
                commands.bind(number, mParameters);
                break;
            case shader::kBindingChunks:
                commands.bind(number, mChunks);
                break;
            case shader::kBindingGroups:
                commands.bind(number, mGroups);
                break;
            case shader::kBindingTotals:
                commands.bind(number, mTotals);
                break;
            case shader::kBindingEmitters:
                commands.bind(number, mEmitters);
                break;
            case shader::kBindingBatches:
                commands.bind(number, mBatches);
                break;
            case shader::kBindingTicks:
                commands.bind(number, mTicks);
                break;
            default:
                if (number >= shader::kBindingNewPositions)
                    commands.bind(number,
                                  stateRange(1 - mCurrent, number - shader::kBindingNewPositions));
                else
                    commands.bind(number, stateRange(mCurrent, number - shader::kBindingPositions));
        }
    }
}

std::uint64_t GpuSimulation::bytes() const {
    std::uint64_t sum = 0;
    for (const gpu::Buffer* buffer : {&mStates[0], &mStates[1], &mParameters, &mEmitters, &mBatches,
                                      &mTicks, &mChunks, &mGroups, &mTotals})
        sum += buffer->bytes();
    return sum;
}

void GpuSimulation::restart() {
    mSchedule = mEffect.schedule;
    mAliveBound = mEffect.aliveBound;
    mMustClear = true;
}

void GpuSimulation::recordAdvanceTo(gpu::Commands& commands, double seconds) {
    const std::uint64_t target = ticksAt(seconds, mEffect.tickRate);
    if (target < tick()) restart();
    recordTicks(commands, target - tick());
}

void GpuSimulation::recordTicks(gpu::Commands& commands, std::uint64_t ticks) {
    if (ticks == 0) return;
    commands.beginLabel("particles.simulate");
    // Whatever read the buffers below before is done with them.
    commands.computeTransferBarrier();
    if (mMustClear) {
        commands.fillBuffer(mTotals, 0);
        mMustClear = false;
    }
    for (std::uint64_t end = tick() + ticks; tick() < end;) {
        const Part part = schedulePart(end - tick());
        updateArray(commands, mTicks, part.ticks);
        updateArray(commands, mBatches, part.batches);
        commands.computeTransferBarrier();
        for (std::uint32_t slot = 0; slot < part.ticks.size(); ++slot)
            recordTick(commands, part.ticks[slot], slot);
        commands.computeTransferBarrier();
    }
    commands.endLabel();
}

GpuSimulation::Part GpuSimulation::schedulePart(std::uint64_t maxTicks) {
    Part part;
    maxTicks = std::min<std::uint64_t>(maxTicks, kTicksPerPart);
    while (part.ticks.size() < maxTicks &&
           part.batches.size() + mSchedule.maxBatchesPerTick() <= mBatchCapacity) {
        const TickBirths births = mSchedule.next();
        part.ticks.push_back(makeTick(births, static_cast<std::uint32_t>(part.batches.size())));
        part.batches.insert(part.batches.end(), births.batches.begin(), births.batches.end());
    }
    return part;
}

/// The tick that the schedule has just given.
shader::Tick GpuSimulation::makeTick(const TickBirths& births, std::uint32_t firstBatch) {
    shader::Tick tick{};
    tick.capacity = mEffect.capacity;
    tick.index = static_cast<std::uint32_t>(mSchedule.tick() - 1);
    tick.chunkSize = mChunkSize;
    tick.survivorChunks = divideUp(slotCount(), mChunkSize);
    tick.birthChunks = divideUp(births.count, mChunkSize);
    tick.firstBatch = firstBatch;
    tick.batchCount = static_cast<std::uint32_t>(births.batches.size());
    tick.birthCount = births.count;
    tick.overflow = births.overflow;
    mAliveBound.addTick(births.count);
    tick.slots = slotCount();
    return tick;
}

void GpuSimulation::recordTick(gpu::Commands& commands, const shader::Tick& tick,
                               std::uint32_t slot) {
    const std::uint32_t chunks = tick.survivorChunks + tick.birthChunks;
    const std::uint32_t groups = divideUp(tick.survivorChunks, shader::kChunksPerGroup) +
                                 divideUp(tick.birthChunks, shader::kChunksPerGroup);
    const auto dispatch = [&](const gpu::ComputePipeline& pipeline, std::uint32_t threads) {
        if (threads == 0) return;
        bindForTick(commands, pipeline);
        commands.pushConstants(shader::TickPush{slot});
        commands.dispatchThreads(threads, mWorkgroupSize);
        commands.computeBarrier();
    };
    dispatch(mCount, chunks);
    dispatch(mOffsets, groups);
    dispatch(mTotalsPass, 1);
    dispatch(mStep, chunks);
    mCurrent = 1 - mCurrent;
}

void GpuSimulation::recordAppearance(gpu::Commands& commands, const Appearance& appearance) {
    if (slotCount() == 0) return;
    const dmat4& m = appearance.worldFromEffect;
    shader::AppearancePush push{};
    push.axisX = vec3(dvec3(m[0]));
    push.axisY = vec3(dvec3(m[1]));
    push.axisZ = vec3(dvec3(m[2]));
    const dvec3 origin = dvec3(m[3]) - appearance.cameraPosition;
    push.origin = vec3(origin);
    push.originLo = vec3(origin - dvec3(push.origin));
    push.radiusScale = static_cast<float>(lengthScale(m));
    push.firstSphere = appearance.firstSphere;
    push.lastTick = static_cast<std::uint32_t>(tick() - 1);
    push.medium = appearance.medium;
    push.firstId = appearance.firstId;
    push.profile = static_cast<std::uint32_t>(mEffect.profile);

    commands.beginLabel("particles.appearance");
    commands.bindCompute(mAppearance);
    commands.bind(shader::kBindingEffect, mParameters);
    commands.bind(shader::kBindingPositions, stateRange(mCurrent, 0));
    commands.bind(shader::kBindingLives, stateRange(mCurrent, 2));
    commands.bind(shader::kBindingBirthIndices, stateRange(mCurrent, 3));
    commands.bind(shader::kBindingTotals, mTotals);
    commands.bind(shader::kBindingParticleSpheres, *appearance.spheres);
    commands.pushConstants(push);
    commands.dispatchThreads(slotCount(), mWorkgroupSize);
    commands.computeBarrier();
    commands.endLabel();
}

GpuSimulation::Snapshot GpuSimulation::readState(gpu::Submitter& submitter) const {
    Snapshot snapshot;
    snapshot.tick = tick();
    if (tick() == 0) return snapshot;
    submitter.read(mTotals, &snapshot.counters, sizeof snapshot.counters);
    const std::uint64_t count = snapshot.counters.alive;
    if (count == 0) return snapshot;
    const gpu::Buffer& state = mStates[mCurrent];
    const auto offsets = stateOffsets();
    const auto positions = submitter.readBuffer<vec3>(state, count, offsets[0]);
    const auto velocities = submitter.readBuffer<vec3>(state, count, offsets[1]);
    const auto lives = submitter.readBuffer<shader::ParticleLife>(state, count, offsets[2]);
    const auto indices = submitter.readBuffer<std::uint32_t>(state, count, offsets[3]);
    snapshot.particles.resize(count);
    for (std::size_t i = 0; i < count; ++i)
        snapshot.particles[i] = {positions[i], velocities[i], lives[i], indices[i]};
    return snapshot;
}

}  // namespace brume::particles
