// SPDX-License-Identifier: Apache-2.0
// The simulator on the CPU: the twin that says what the GPU must give, bit by bit.
#pragma once

#include <particles/compiled_effect.hpp>

namespace brume::particles {

/// One instance of an effect. Its state depends on the effect, seed, instance and tick alone.
class CpuSimulation {
  public:
    /// Throws an input Error as compileEffect().
    CpuSimulation(const scene::Effect& effect, std::uint64_t seed, std::uint32_t instance = 0);

    void step(std::uint64_t ticks);

    /// To the last tick that is over at `seconds`; starts anew if that lies in the past.
    void advanceTo(double seconds);

    std::uint64_t tick() const { return mSchedule.tick(); }                ///< ticks done
    const std::vector<Particle>& particles() const { return mParticles; }  ///< in order of birth
    const Counters& counters() const { return mCounters; }
    const CompiledEffect& effect() const { return mEffect; }
    std::uint64_t hash() const { return hashParticles(mParticles, tick()); }

    /// As makeSpheres().
    std::vector<scene::MediumSphere> spheres(const dmat4& worldFromEffect, std::uint32_t medium,
                                             std::uint32_t firstId) const;

  private:
    void stepSurvivors(std::uint32_t tick);
    void appendBirths(const TickBirths& births, std::uint32_t tick);

    CompiledEffect mEffect;
    SpawnSchedule mSchedule;
    std::vector<Particle> mParticles;
    Counters mCounters{};
};

}  // namespace brume::particles
