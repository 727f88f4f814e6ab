// SPDX-License-Identifier: Apache-2.0
// The particles of one effect on the GPU, of all its instances: buffers, pipelines and the passes
// of a tick. Part of GpuSimulation.
#pragma once

#include <shaders/particles/passes.h>

#include <array>
#include <gpu/commands.hpp>
#include <gpu/submitter.hpp>
#include <gpu/timer_pool.hpp>
#include <particles/compiled_effect.hpp>
#include <scene/camera.hpp>

namespace brume::particles {

/// How the work is cut; the particles do not depend on it.
struct GpuSimulationOptions {
    std::uint32_t workgroupSize = 64;
    std::uint32_t chunkSize = 0;  ///< particles per invocation; 0: what suits the device. Never
                                  ///< more than what a software device finishes
    gpu::TimerPool* timers = nullptr;  ///< gets a scope for each pass of each tick; outlives them
};

/// Which instance of an effect: see instanceParameters().
struct EffectInstance {
    std::uint64_t seed = 0;
    std::uint32_t instance = 0;
    scene::Placement placement{};  ///< of effects in world space
};

/// What the module collide_depth collides with; everything must live until the commands are done.
struct SceneDepth {
    const gpu::Image* distance = nullptr;  ///< along the rays of the camera, m; ready to be sampled
    const gpu::Sampler* sampler = nullptr;
    scene::CameraFrame camera;  ///< as large as the image
};

/// Ticks that are recorded together, because their parameters are uploaded together.
struct TickPart {
    std::vector<shader::Tick> ticks;
    std::vector<shader::BirthBatch> batches;
    // In world space, for each tick and instance:
    std::vector<shader::InstanceTick> instances;
    std::vector<shader::CurlNoiseShift> noise;  ///< and each curl_noise
};

class GpuPopulation {
  public:
    GpuPopulation(gpu::Device& device, CompiledEffect effect, std::uint32_t population,
                  std::span<const EffectInstance> instances, const GpuSimulationOptions& options,
                  const GpuPopulation* parent);

    const CompiledEffect& effect() const { return mEffect; }
    std::uint32_t slotCount() const { return mAliveBound.value(); }  ///< of one instance
    std::uint32_t instanceCount() const { return mInstanceCount; }
    std::uint64_t bytes() const;

    /// Starts anew at `tick` with nothing alive; the bound on what is follows the schedule.
    void restart(std::uint64_t tick);
    /// The next ticks, at most `maxTicks`, as many as are uploaded at once. `spaces`: of the
    /// instances, in world space.
    const TickPart& schedulePart(std::uint64_t firstTick, std::uint64_t maxTicks,
                                 std::span<const InstanceSpace> spaces);
    /// What schedulePart() has returned last.
    const TickPart& part() const { return mPart; }

    /// Nothing is alive at `tick`, where restart() went.
    void recordClear(gpu::Commands& commands, std::uint64_t tick) const;
    void recordUpload(gpu::Commands& commands, const TickPart& part) const;
    /// The instances are turned otherwise now.
    void recordAxes(gpu::Commands& commands, std::span<const InstanceSpace> spaces);
    void recordTick(gpu::Commands& commands, const shader::Tick& tick, std::uint32_t slot);
    /// Makes what the tick's step has listed the births of the child's tick.
    void recordChildren(gpu::Commands& commands, const shader::Tick& tick, std::uint32_t slot,
                        GpuPopulation& child) const;
    /// Writes slotCount() spheres of each instance; `places`: one per instance.
    void recordAppearance(gpu::Commands& commands, const gpu::Buffer& spheres,
                          const shader::AppearanceFrame& frame,
                          std::span<const shader::AppearancePlace> places) const;

    /// From now on particles collide with it; `places`: one per instance.
    void recordSceneDepth(gpu::Commands& commands, const SceneDepth& depth,
                          std::span<const shader::DepthPlace> places);
    void forgetSceneDepth() { mSceneDepth.reset(); }

    /// Of all instances together.
    Counters readCounters(gpu::Submitter& submitter) const;
    /// Also the strands, if the effect keeps them.
    std::vector<Particle> readParticles(gpu::Submitter& submitter, std::uint32_t instance,
                                        Counters& counters,
                                        std::vector<std::uint32_t>& strands) const;
    /// Replaces the state of an instance; at most the capacity.
    void writeParticles(gpu::Submitter& submitter, std::uint32_t instance,
                        std::span<const Particle> particles,
                        const std::vector<std::uint32_t>& strands, const Counters& counters);

  private:
    void makeBuffers(gpu::Device& device);
    void makePipelines(gpu::Device& device);
    std::vector<std::uint32_t> specialization() const;
    shader::Tick makeTick(std::uint64_t tick, const TickBirths& births, std::uint32_t firstBatch);
    void recordDepthCollision(gpu::Commands& commands, std::uint32_t slots);
    void addBatches(std::uint64_t tick, std::span<const InstanceSpace> spaces);
    void addInstanceTicks(std::uint64_t tick, std::span<const InstanceSpace> spaces);
    /// Batches of a tick at most, of all instances that have their own.
    std::uint64_t maxBatches() const;
    /// Where the arrays of a state begin: words of the particles, strands, end.
    std::array<std::uint64_t, shader::kStateWords + 2> stateOffsets() const;
    gpu::BufferRange stateRange(std::uint32_t state, std::uint32_t array) const;
    const gpu::Buffer* bufferOf(std::uint32_t binding) const;
    void bindAll(gpu::Commands& commands, const gpu::ComputePipeline& pipeline) const;
    std::uint64_t maxChunks() const;  // of one instance
    /// Batches of one sub-emitter and instance in one tick.
    std::uint64_t maxRecords() const { return maxChunks() * mChunkSize; }
    std::uint32_t batchStride() const { return mBatchStride; }

    CompiledEffect mEffect;
    TickPart mPart;
    TickBirths mBirths;
    AliveBound mAliveBound;
    std::uint32_t mInstanceCount;
    gpu::TimerPool* mTimers;
    std::uint32_t mWorkgroupSize;
    std::uint32_t mChunkSize;
    std::uint32_t mBatchCapacity = 0;
    std::uint32_t mBatchStride = 0;  // of a child: batches of one instance
    std::uint32_t mCurrent = 0;      // which of the states is the newest

    gpu::Buffer mStates[2];
    gpu::Buffer mParameters, mEmitters, mInstances, mTriangles, mFieldValues;
    gpu::Buffer mBatches, mTicks;
    gpu::Buffer mChunks, mGroups, mTotals;
    gpu::Buffer mRecords, mRecordCounts;
    gpu::Buffer mAppearanceData;
    gpu::Buffer mInstanceTicks, mInstanceNoise;
    gpu::Buffer mDepthCollision;
    std::optional<SceneDepth> mSceneDepth;
    std::vector<shader::InstanceParameters> mInstanceData;
    std::uint32_t mTicksPerPart = 1;
    gpu::ComputePipeline mCount, mOffsets, mTotalsPass, mStep, mAppearance;
    gpu::ComputePipeline mChildOffsets, mChildBatches, mCollideDepth;
};

}  // namespace brume::particles
