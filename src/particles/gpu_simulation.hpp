// SPDX-License-Identifier: Apache-2.0
// The simulator on the GPU: same bits as CpuSimulation. It records into commands that it is given
// and reads nothing back, so any number of ticks fits into one submission.
#pragma once

#include <shaders/particles/passes.h>

#include <array>
#include <gpu/commands.hpp>
#include <gpu/submitter.hpp>
#include <particles/compiled_effect.hpp>

namespace brume::particles {

/// How the work is cut; the particles do not depend on it.
struct GpuSimulationOptions {
    std::uint32_t workgroupSize = 64;
    std::uint32_t chunkSize = 0;  ///< particles per invocation, 1 to 4096; 0: what suits the device
};

/// One instance of an effect. 80 bytes per particle of capacity (two states). The calls that record
/// belong to one queue, in their order; each leaves its results visible to compute shaders recorded
/// after it, and expects buffers it reads or writes to be free. Everything must live until the
/// commands are done.
class GpuSimulation {
  public:
    /// Throws an input Error as compileEffect(), a failure Error if memory is short.
    GpuSimulation(gpu::Device& device, const scene::Effect& effect, std::uint64_t seed,
                  std::uint32_t instance = 0, const GpuSimulationOptions& options = {});

    void recordTicks(gpu::Commands& commands, std::uint64_t ticks);

    /// To the last tick that is over at `seconds`; starts anew if that lies in the past.
    void recordAdvanceTo(gpu::Commands& commands, double seconds);

    /// Spheres that recordAppearance() writes: no more particles than that can be alive.
    std::uint32_t slotCount() const { return mAliveBound.value(); }

    /// Where and how the particles appear.
    struct Appearance {
        dmat4 worldFromEffect{1};
        dvec3 cameraPosition{0};  ///< world; the spheres' centres are relative to it
        std::uint32_t medium = 0;
        std::uint32_t firstId = 0;             ///< sphere id = firstId + birth index
        const gpu::Buffer* spheres = nullptr;  ///< of shader::SphereData
        std::uint32_t firstSphere = 0;         ///< fills [firstSphere, firstSphere + slotCount())
    };

    /// Writes all slots; those without a particle get radius 0. Records nothing if there are none.
    void recordAppearance(gpu::Commands& commands, const Appearance& appearance);

    std::uint64_t tick() const { return mSchedule.tick(); }  ///< ticks recorded
    const CompiledEffect& effect() const { return mEffect; }
    std::uint64_t bytes() const;  ///< of buffers

    /// The state after the recorded ticks, for tests, hashes and the reference.
    struct Snapshot {
        std::vector<Particle> particles;  ///< in order of birth
        Counters counters{};
        std::uint64_t tick = 0;
        std::uint64_t hash() const { return hashParticles(particles, tick); }
    };
    /// Submits and waits; all recorded ticks must have been submitted.
    Snapshot readState(gpu::Submitter& submitter) const;

  private:
    void makeBuffers(gpu::Device& device);
    void makePipelines(gpu::Device& device);
    void restart();
    /// Ticks that are recorded together, because their parameters are uploaded together.
    struct Part {
        std::vector<shader::Tick> ticks;
        std::vector<shader::BirthBatch> batches;
    };
    Part schedulePart(std::uint64_t maxTicks);
    shader::Tick makeTick(const TickBirths& births, std::uint32_t firstBatch);
    void recordTick(gpu::Commands& commands, const shader::Tick& tick, std::uint32_t slot);
    /// Where the arrays of a state begin: positions, velocities, lives, birth indices, end.
    std::array<std::uint64_t, 5> stateOffsets() const;
    gpu::BufferRange stateRange(std::uint32_t state, std::uint32_t field) const;
    void bindForTick(gpu::Commands& commands, const gpu::ComputePipeline& pipeline) const;

    CompiledEffect mEffect;
    SpawnSchedule mSchedule;
    AliveBound mAliveBound;
    std::uint32_t mWorkgroupSize;
    std::uint32_t mChunkSize;
    std::uint32_t mBatchCapacity = 0;
    std::uint32_t mCurrent = 0;  // which of the states is the newest
    bool mMustClear = true;

    gpu::Buffer mStates[2];
    gpu::Buffer mParameters;
    gpu::Buffer mEmitters;
    gpu::Buffer mBatches;
    gpu::Buffer mTicks;
    gpu::Buffer mChunks;
    gpu::Buffer mGroups;
    gpu::Buffer mTotals;
    gpu::ComputePipeline mCount;
    gpu::ComputePipeline mOffsets;
    gpu::ComputePipeline mTotalsPass;
    gpu::ComputePipeline mStep;
    gpu::ComputePipeline mAppearance;
};

}  // namespace brume::particles
