// SPDX-License-Identifier: Apache-2.0
// The simulator on the GPU: same bits as CpuSimulation. It records into commands that it is given
// and reads nothing back, so any number of ticks fits into one submission.
#pragma once

#include <particles/gpu_population.hpp>
#include <particles/simulation_state.hpp>

#include <memory>

namespace brume::particles {

/// Instances of one effect, which go through the same ticks in the same dispatches: four per tick
/// for the effect, six for each sub-emitter, however many instances there are. 80 bytes per
/// particle of capacity and instance (two states). The calls that record belong to one queue, in
/// their order; each leaves its results visible to compute shaders recorded after it, and expects
/// buffers it reads or writes to be free. Everything must live until the commands are done.
class GpuSimulation {
  public:
    /// Throws an input Error as compileEffect(), a failure Error if memory is short.
    GpuSimulation(gpu::Device& device, const scene::Effect& effect,
                  std::span<const EffectInstance> instances,
                  const GpuSimulationOptions& options = {});
    /// One instance.
    GpuSimulation(gpu::Device& device, const scene::Effect& effect, std::uint64_t seed,
                  std::uint32_t instance = 0, const GpuSimulationOptions& options = {});

    void recordTicks(gpu::Commands& commands, std::uint64_t ticks);

    /// To the last tick that is over at `seconds`; starts anew if that lies in the past. Leaves out
    /// the ticks before jumpTick(); then the counters take it that nothing was rejected in them.
    /// Stops after `maxTicks`, for frames that must end in time, and returns the number of ticks
    /// still to go, for the next call: no time is lost.
    std::uint64_t recordAdvanceTo(gpu::Commands& commands, double seconds,
                                  std::uint64_t maxTicks = ~std::uint64_t{0});

    /// Where the particles of an instance are now; `worldFromEffect`: where the instance is, for
    /// local space.
    ParticleFrame frame(std::uint32_t instance, const dmat4& worldFromEffect) const;
    /// In world space: a host moves an instance, straight while it goes on to `seconds`. In local
    /// space, or where that is its last transform, nothing happens.
    void moveTo(std::uint32_t instance, const dmat4& worldFromEffect, double seconds);
    /// In world space: the world counts from another point now; nothing moves.
    void rebase(const dvec3& newOrigin);

    /// Whether a population has the module collide_depth, which does nothing before recordSceneDepth().
    bool wantsSceneDepth() const;
    /// The ticks recorded from now on collide with what a picture shows; `worldFromEffect`: where
    /// the instances are. The image must stay until the next call or forgetSceneDepth().
    void recordSceneDepth(gpu::Commands& commands, const SceneDepth& depth,
                          std::span<const dmat4> worldFromEffect);
    void forgetSceneDepth() {
        for (const auto& population : mPopulations) population->forgetSceneDepth();
    }

    std::uint32_t populationCount() const { return static_cast<std::uint32_t>(mPopulations.size()); }
    std::uint32_t instanceCount() const { return mPopulations[0]->instanceCount(); }

    /// Spheres that recordAppearance() writes: no more particles than that can be alive.
    std::uint32_t slotCount(std::uint32_t population = 0) const {
        return mPopulations[population]->slotCount();
    }

    /// Where and how a population of an instance appears.
    struct Appearance {
        ParticleFrame frame;            ///< see frame()
        std::uint32_t medium = 0;
        std::uint32_t firstId = 0;      ///< sphere id = firstId + birth index
        std::uint32_t firstSphere = 0;  ///< fills [firstSphere, firstSphere + slotCount())
    };

    /// Writes all slots of a population of all instances (`appearances`: in the order of the
    /// constructor's) in one dispatch, at the time of the last recordAdvanceTo() or at the end of
    /// the last tick; those without a particle, or thinned out, get radius 0. Centres are relative
    /// to the viewer.
    /// `spheres`: of shader::SphereData. Records nothing if there are none.
    void recordAppearance(gpu::Commands& commands, std::uint32_t population,
                          const Viewer& viewer, std::span<const Appearance> appearances,
                          const gpu::Buffer& spheres);

    std::uint64_t tick() const { return mTick; }  ///< ticks recorded
    double sinceTick() const { return mSinceTick; }  ///< ticks beyond them, [0, 1), for appearance
    const CompiledEffect& effect(std::uint32_t population = 0) const {
        return mPopulations[population]->effect();
    }
    /// Of all populations.
    std::vector<CompiledEffect> effects() const;
    std::uint64_t bytes() const;  ///< of buffers

    /// The state after the recorded ticks, for tests, hashes, checkpoints and the reference.
    /// Submits and waits; all recorded ticks must have been submitted.
    SimulationState readState(gpu::Submitter& submitter, std::uint32_t instance = 0) const;

    /// Of all instances of a population together. Submits and waits, as readState().
    Counters readCounters(gpu::Submitter& submitter, std::uint32_t population) const;

    /// Goes on from a state. All instances must be given states of one tick. Submits and waits.
    void writeState(gpu::Submitter& submitter, std::span<const SimulationState> states);

  private:
    void restart(std::uint64_t tick);

    std::vector<std::unique_ptr<GpuPopulation>> mPopulations;
    std::uint64_t mTick = 0;
    double mSinceTick = 0;
    bool mMustClear = true;
    bool mMustTurn = false;              // the axes of instances are new
    std::vector<InstanceSpace> mSpaces;  // of the instances, in world space
    std::vector<shader::AppearancePlace> mAppearancePlaces;  // keeps its memory
};

}  // namespace brume::particles
