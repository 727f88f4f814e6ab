// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <core/assert.hpp>
#include <core/error.hpp>
#include <particles/gpu_population.hpp>

#include <algorithm>
#include <cstring>
#include <numeric>

namespace brume::particles {

using shader::kStateWords;

namespace {

std::uint32_t divideUp(std::uint64_t a, std::uint64_t b) {
    return static_cast<std::uint32_t>((a + b - 1) / b);
}

/// Loop iterations of one particle in the step pass, estimated from above: lavapipe silently stops
/// an invocation at 65 535 of them.
std::uint32_t loopsPerParticle(const CompiledEffect& effect) {
    const shader::EffectParameters& p = effect.parameters;
    std::uint32_t loops = 48;  // births: random numbers, search of batch and triangle
    for (std::uint32_t i = 0; i < p.curlNoiseCount; ++i) loops += 2 + p.curlNoise[i].octaves;
    loops += 16 * (p.attractorCount + p.vortexCount + 2 * p.quadraticDragCount);
    // A sample of a grid's component takes two, those of a level set's gradient six times as many.
    loops += 20 * p.velocityFieldCount + 4 * p.buoyancyCount + 10 * p.birthFieldCount;
    loops += 5 * p.levelSetColliderCount *
             (3 * (shader::kMaxLevelSetSteps + shader::kLevelSetBisections) + 80);
    const std::uint32_t colliders = p.planeColliderCount + p.sphereColliderCount +
                                    p.boxColliderCount + p.capsuleColliderCount;
    loops += 5 * 30 * colliders + (colliders ? 60 : 0);
    loops *= effect.subEmitterCount ? 2 : 1;  // dying particles are followed too
    return loops + 40 * effect.subEmitterCount;
}

/// Software devices like long serial runs as long as there are enough for their threads and lanes,
/// GPUs like many threads; chosen by us from measurements.
std::uint32_t chooseChunkSize(const gpu::Device& device, const CompiledEffect& effect,
                              std::uint32_t instances, std::uint32_t wanted) {
    constexpr std::uint32_t kMaxLoops = 45000, kMaxChunks = 32768;
    const std::uint64_t all = std::uint64_t{effect.capacity} * instances;
    auto usual = static_cast<std::uint32_t>(
        device.isLavapipe() ? std::clamp<std::uint64_t>(all / 512, 4, 1000) : 16);
    // Neighbouring chunks should not begin in the same sets of the caches.
    if (usual % 64 == 0) usual += 8;
    const std::uint32_t most = std::max(1u, kMaxLoops / loopsPerParticle(effect));
    // The pass over the chunks of an instance is serial in two places.
    const std::uint32_t least = divideUp(effect.capacity, kMaxChunks);
    return std::max(std::min(wanted ? wanted : usual, most), least);
}

/// Ticks whose parameters are uploaded at once; chosen by us, a second of most effects. Fewer where
/// each instance has its own.
std::uint32_t ticksPerPart(const CompiledEffect& effect, std::uint32_t instances) {
    constexpr std::uint32_t kMost = 128, kMostOfInstances = 1u << 16u;
    return effect.isWorldSpace() ? std::clamp(kMostOfInstances / instances, 1u, kMost) : kMost;
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

gpu::Buffer makeBuffer(gpu::Device& device, const std::string& name, std::uint64_t bytes) {
    return gpu::Buffer(device, {.name = name, .bytes = std::max<std::uint64_t>(bytes, 4)});
}

}  // namespace

GpuPopulation::GpuPopulation(gpu::Device& device, CompiledEffect effect, std::uint32_t population,
                             std::span<const EffectInstance> instances,
                             const GpuSimulationOptions& options, const GpuPopulation* parent)
    : mEffect(std::move(effect)),
      mAliveBound(mEffect.aliveBound),
      mInstanceCount(static_cast<std::uint32_t>(instances.size())),
      mTimers(options.timers),
      mWorkgroupSize(options.workgroupSize),
      mChunkSize(chooseChunkSize(device, mEffect, mInstanceCount, options.chunkSize)) {
    BRUME_ASSERT_LT(0u, mInstanceCount);
    for (const EffectInstance& one : instances) {
        mInstanceData.push_back(instanceParameters(one.seed, one.instance, population));
        if (mEffect.isWorldSpace())
            InstanceSpace(one.placement, mEffect.tickRate).setAxes(mInstanceData.back());
    }
    mTicksPerPart = ticksPerPart(mEffect, mInstanceCount);
    mInstances = makeFilledBuffer<shader::InstanceParameters>(device, "particles.instances",
                                                              mInstanceData);
    mBatchStride = parent ? static_cast<std::uint32_t>(parent->maxRecords()) : 0;
    makeBuffers(device);
    makePipelines(device);
    restart(0);
}

std::uint64_t GpuPopulation::maxChunks() const {
    // Existing particles and births each have up to as many as the capacity takes.
    return 2 * std::uint64_t{divideUp(mEffect.capacity, mChunkSize)};
}

void GpuPopulation::makeBuffers(gpu::Device& device) {
    const std::uint64_t all = std::uint64_t{mEffect.capacity} * mInstanceCount;
    const std::uint64_t chunks = maxChunks() * mInstanceCount;
    const std::uint64_t groups =
        (2 + divideUp(maxChunks(), shader::kChunksPerGroup)) * std::uint64_t{mInstanceCount};
    const std::uint64_t records = mEffect.subEmitterCount * maxRecords() * mInstanceCount;
    constexpr std::uint32_t kUsualBatches = 2048;
    mBatchCapacity = mEffect.isChild()
                         ? mBatchStride * mInstanceCount
                         : static_cast<std::uint32_t>(
                               std::max<std::uint64_t>(kUsualBatches, maxBatches()));

    const std::uint64_t largest =
        std::max({all * sizeof(std::uint64_t), records * sizeof(shader::BirthBatch),
                  mBatchCapacity * std::uint64_t{sizeof(shader::BirthBatch)}});
    if (largest > device.limits().maxStorageBufferRange)
        throw inputError(
            "setting up an effect", "",
            fmt::format("'capacity' {} of {} instances wants an array of {} bytes, at most {} "
                        "allowed on this device",
                        mEffect.capacity, mInstanceCount, largest,
                        device.limits().maxStorageBufferRange));
    mStates[0] = makeBuffer(device, "particles.stateA", stateOffsets().back());
    mStates[1] = makeBuffer(device, "particles.stateB", stateOffsets().back());
    mTicks = makeBuffer(device, "particles.ticks", mTicksPerPart * sizeof(shader::Tick));
    const std::uint64_t instanceTicks =
        mEffect.isWorldSpace() ? std::uint64_t{mTicksPerPart} * mInstanceCount : 0;
    mInstanceTicks = makeBuffer(device, "particles.instance_ticks",
                                instanceTicks * sizeof(shader::InstanceTick));
    mInstanceNoise = makeBuffer(
        device, "particles.instance_noise",
        instanceTicks * mEffect.parameters.curlNoiseCount * sizeof(shader::CurlNoiseShift));
    mChunks = makeBuffer(device, "particles.chunks", chunks * 4);
    mGroups = makeBuffer(device, "particles.groups", groups * 4);
    mTotals =
        makeBuffer(device, "particles.totals", mInstanceCount * sizeof(shader::TickTotals));
    mRecords = makeBuffer(device, "particles.records", records * sizeof(shader::BirthBatch));
    mRecordCounts = makeBuffer(device, "particles.record_counts",
                               mEffect.subEmitterCount * chunks * sizeof(shader::RecordCount));
    mAppearanceData =
        makeBuffer(device, "particles.appearance",
                   sizeof(shader::AppearanceFrame) +
                       mInstanceCount * std::uint64_t{sizeof(shader::AppearancePlace)});
    if (mEffect.depthCollider)
        mDepthCollision =
            makeBuffer(device, "particles.depth_collision",
                       sizeof(shader::DepthCollision) +
                           mInstanceCount * std::uint64_t{sizeof(shader::DepthPlace)});
    mBatches = makeBuffer(device, "particles.batches", mBatchCapacity * sizeof(shader::BirthBatch));
    mParameters = makeFilledBuffer<shader::EffectParameters>(device, "particles.parameters",
                                                             {&mEffect.parameters, 1});
    mEmitters =
        makeFilledBuffer<shader::EmitterParameters>(device, "particles.emitters", mEffect.emitters);
    mTriangles =
        makeFilledBuffer<shader::EmitterTriangle>(device, "particles.triangles", mEffect.triangles);
    mFieldValues = makeFilledBuffer<float>(device, "particles.fields", mEffect.fieldValues);
}

std::array<std::uint64_t, kStateWords + 2> GpuPopulation::stateOffsets() const {
    std::array<std::uint64_t, kStateWords + 2> offsets{};
    // Bindings begin at multiples of 256 bytes, and none is empty.
    const std::uint64_t all =
        std::max<std::uint64_t>(std::uint64_t{mEffect.capacity} * mInstanceCount, 1);
    for (std::size_t i = 0; i <= kStateWords; ++i) {
        const std::uint64_t bytes = i < kStateWords      ? all * sizeof(std::uint64_t)
                                    : mEffect.hasStrands ? all * sizeof(std::uint32_t)
                                                         : 1;
        offsets[i + 1] = offsets[i] + (bytes + 255) / 256 * 256;
    }
    return offsets;
}

gpu::BufferRange GpuPopulation::stateRange(std::uint32_t state, std::uint32_t array) const {
    const auto offsets = stateOffsets();
    return {&mStates[state], offsets[array], offsets[array + 1] - offsets[array]};
}

const gpu::Buffer* GpuPopulation::bufferOf(std::uint32_t binding) const {
    switch (binding) {
        case shader::kBindingEffect: return &mParameters;
        case shader::kBindingChunks: return &mChunks;
        case shader::kBindingGroups: return &mGroups;
        case shader::kBindingTotals: return &mTotals;
        case shader::kBindingEmitters: return &mEmitters;
        case shader::kBindingBatches: return &mBatches;
        case shader::kBindingTicks: return &mTicks;
        case shader::kBindingInstances: return &mInstances;
        case shader::kBindingTriangles: return &mTriangles;
        case shader::kBindingFieldValues: return &mFieldValues;
        case shader::kBindingRecords: return &mRecords;
        case shader::kBindingRecordCounts: return &mRecordCounts;
        case shader::kBindingAppearance: return &mAppearanceData;
        case shader::kBindingInstanceTicks: return &mInstanceTicks;
        case shader::kBindingInstanceNoise: return &mInstanceNoise;
        case shader::kBindingDepthCollider: return &mDepthCollision;
        default: return nullptr;
    }
}

void GpuPopulation::bindAll(gpu::Commands& commands, const gpu::ComputePipeline& pipeline) const {
    commands.bindCompute(pipeline);
    for (const gpu::Binding& binding : pipeline.bindings()) {
        const std::uint32_t number = binding.number;
        if (const gpu::Buffer* buffer = bufferOf(number))
            commands.bind(number, *buffer);
        else if (number >= shader::kBindingState && number < shader::kBindingState + kStateWords)
            commands.bind(number, stateRange(mCurrent, number - shader::kBindingState));
        else if (number >= shader::kBindingNewState &&
                 number < shader::kBindingNewState + kStateWords)
            commands.bind(number, stateRange(1 - mCurrent, number - shader::kBindingNewState));
        else if (number == shader::kBindingStrands)
            commands.bind(number, stateRange(mCurrent, kStateWords));
        else if (number == shader::kBindingNewStrands)
            commands.bind(number, stateRange(1 - mCurrent, kStateWords));
    }
}

std::uint64_t GpuPopulation::bytes() const {
    std::uint64_t sum = 0;
    for (const gpu::Buffer* buffer :
         {&mStates[0], &mStates[1], &mParameters, &mEmitters, &mInstances, &mTriangles,
          &mFieldValues, &mBatches, &mTicks, &mChunks, &mGroups, &mTotals, &mRecords, &mRecordCounts,
          &mAppearanceData, &mInstanceTicks, &mInstanceNoise, &mDepthCollision})
        sum += buffer->bytes();
    return sum;
}

void GpuPopulation::restart(std::uint64_t tick) {
    mAliveBound = mEffect.aliveBound;
    if (mEffect.isChild()) {
        // Its births are known to the GPU alone.
        mAliveBound.addTick(mEffect.capacity);
        return;
    }
    if (tick > 0 && mAliveBound.windowTicks() == 0) {
        const std::uint64_t births = mEffect.schedule.birthsBefore(tick);
        mAliveBound.addTick(
            static_cast<std::uint32_t>(std::min<std::uint64_t>(births, mEffect.capacity)));
        return;
    }
    for (std::uint64_t t = tick - std::min<std::uint64_t>(tick, mAliveBound.windowTicks());
         t < tick; ++t)
        mAliveBound.addTick(mEffect.schedule.at(t).count);
}

std::uint64_t GpuPopulation::maxBatches() const {
    return std::uint64_t{mEffect.schedule.maxBatchesPerTick()} *
           (mEffect.isWorldSpace() ? mInstanceCount : 1);
}

const TickPart& GpuPopulation::schedulePart(std::uint64_t firstTick, std::uint64_t maxTicks,
                                            std::span<const InstanceSpace> spaces) {
    TickPart& part = mPart;  // keeps its memory: a steady frame allocates nothing
    part.ticks.clear();
    part.batches.clear();
    part.instances.clear();
    part.noise.clear();
    maxTicks = std::min<std::uint64_t>(maxTicks, mTicksPerPart);
    while (part.ticks.size() < maxTicks &&
           (mEffect.isChild() || part.batches.size() + maxBatches() <= mBatchCapacity)) {
        const std::uint64_t tick = firstTick + part.ticks.size();
        if (!mEffect.isChild()) mEffect.schedule.at(tick, mBirths);
        part.ticks.push_back(
            makeTick(tick, mBirths, static_cast<std::uint32_t>(part.batches.size())));
        addBatches(tick, spaces);
        if (mEffect.isWorldSpace()) addInstanceTicks(tick, spaces);
    }
    return part;
}

void GpuPopulation::addBatches(std::uint64_t tick, std::span<const InstanceSpace> spaces) {
    std::vector<shader::BirthBatch>& batches = mPart.batches;
    if (!mEffect.isWorldSpace()) {
        batches.insert(batches.end(), mBirths.batches.begin(), mBirths.batches.end());
        return;
    }
    for (const InstanceSpace& space : spaces)
        for (const shader::BirthBatch& batch : mBirths.batches) {
            batches.push_back(batch);
            space.place(batches.back(), tick);
        }
}

void GpuPopulation::addInstanceTicks(std::uint64_t tick, std::span<const InstanceSpace> spaces) {
    for (const InstanceSpace& space : spaces) {
        const dvec3 shift = space.shiftAt(tick);
        mPart.instances.push_back({vec3(space.rebaseAt(tick)), vec3(shift)});
        if (mEffect.parameters.curlNoiseCount == 0) continue;
        const shader::TickFields fields = tickFields(mEffect, tick, shift);
        mPart.noise.insert(mPart.noise.end(), fields.curlNoise,
                           fields.curlNoise + mEffect.parameters.curlNoiseCount);
    }
}

shader::Tick GpuPopulation::makeTick(std::uint64_t index, const TickBirths& births,
                                     std::uint32_t firstBatch) {
    shader::Tick tick{};
    const std::uint32_t mostBirths = mEffect.isChild() ? mEffect.capacity : births.count;
    const std::uint32_t birthChunks = divideUp(mostBirths, mChunkSize);
    tick.capacity = mEffect.capacity;
    tick.instances = mInstanceCount;
    tick.index = static_cast<std::uint32_t>(index);
    tick.chunkSize = mChunkSize;
    tick.survivorChunks = divideUp(slotCount(), mChunkSize);
    tick.chunks = tick.survivorChunks + birthChunks;
    tick.groups = divideUp(tick.survivorChunks, shader::kChunksPerGroup) +
                  divideUp(birthChunks, shader::kChunksPerGroup);
    tick.firstBatch = firstBatch;
    tick.batchCount = static_cast<std::uint32_t>(births.batches.size());
    tick.birthCount = births.count;
    tick.overflow = births.overflow;
    if (!mEffect.isChild()) mAliveBound.addTick(births.count);
    tick.slots = slotCount();
    tick.isChild = mEffect.isChild();
    tick.batchStride = mEffect.isChild()        ? mBatchStride
                       : mEffect.isWorldSpace() ? tick.batchCount
                                                : 0;
    tick.fields = tickFields(mEffect, index);
    return tick;
}

void GpuPopulation::recordClear(gpu::Commands& commands, std::uint64_t tick) const {
    commands.fillBuffer(mTotals, 0);
    if (tick == 0) return;
    shader::TickTotals totals{};
    totals.counters.born = static_cast<std::uint32_t>(mEffect.schedule.birthsBefore(tick));
    totals.counters.died = totals.counters.born;
    commands.computeTransferBarrier();
    commands.updateArray<shader::TickTotals>(mTotals, std::vector(mInstanceCount, totals));
}

void GpuPopulation::recordUpload(gpu::Commands& commands, const TickPart& part) const {
    commands.updateArray<shader::Tick>(mTicks, part.ticks);
    commands.updateArray<shader::BirthBatch>(mBatches, part.batches);
    commands.updateArray<shader::InstanceTick>(mInstanceTicks, part.instances);
    commands.updateArray<shader::CurlNoiseShift>(mInstanceNoise, part.noise);
}

void GpuPopulation::recordAxes(gpu::Commands& commands, std::span<const InstanceSpace> spaces) {
    for (std::size_t i = 0; i < spaces.size(); ++i) spaces[i].setAxes(mInstanceData[i]);
    commands.updateArray<shader::InstanceParameters>(mInstances, mInstanceData);
}

void GpuPopulation::recordTick(gpu::Commands& commands, const shader::Tick& tick,
                               std::uint32_t slot) {
    const auto dispatch = [&](const char* name, const gpu::ComputePipeline& pipeline,
                              std::uint64_t threads) {
        if (threads == 0) return;
        const std::size_t scope = mTimers ? mTimers->begin(commands, name) : 0;
        bindAll(commands, pipeline);
        commands.pushConstants(shader::TickPush{slot});
        commands.dispatchThreads(threads, mWorkgroupSize);
        commands.computeBarrier();
        if (mTimers) mTimers->end(commands, scope);
    };
    dispatch("particles.count", mCount, std::uint64_t{tick.chunks} * mInstanceCount);
    dispatch("particles.offsets", mOffsets, std::uint64_t{tick.groups} * mInstanceCount);
    dispatch("particles.totals", mTotalsPass, mInstanceCount);
    dispatch("particles.step", mStep, std::uint64_t{tick.chunks} * mInstanceCount);
    mCurrent = 1 - mCurrent;
    recordDepthCollision(commands, tick.slots);
}

void GpuPopulation::recordChildren(gpu::Commands& commands, const shader::Tick& tick,
                                   std::uint32_t slot, GpuPopulation& child) const {
    const auto dispatch = [&](const gpu::ComputePipeline& pipeline, std::uint64_t threads) {
        commands.bindCompute(pipeline);
        commands.bind(shader::kBindingTicks, mTicks);
        commands.bind(shader::kBindingRecordCounts, mRecordCounts);
        commands.bind(shader::kBindingChildTotals, child.mTotals);
        if (&pipeline == &mChildBatches) {
            commands.bind(shader::kBindingRecords, mRecords);
            commands.bind(shader::kBindingChildBatches, child.mBatches);
        }
        commands.pushConstants(shader::ChildPush{slot, child.effect().subEmitter,
                                                 child.effect().capacity, child.batchStride()});
        commands.dispatchThreads(threads, mWorkgroupSize);
        commands.computeBarrier();
    };
    dispatch(mChildOffsets, mInstanceCount);
    dispatch(mChildBatches, std::uint64_t{tick.chunks} * mInstanceCount);
}

}  // namespace brume::particles
