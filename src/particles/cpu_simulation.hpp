// SPDX-License-Identifier: Apache-2.0
// The simulator on the CPU: the twin that says what the GPU must give, bit by bit.
#pragma once

#include <particles/simulation_state.hpp>

namespace brume::particles {

/// One instance of an effect with its populations: number 0 is the effect itself, the others are
/// those of its sub-emitters, in the order of compileEffect(). Its state depends on the effect,
/// seed, instance and tick alone.
class CpuSimulation {
  public:
    /// Throws an input Error as compileEffect() and requireReplayable().
    CpuSimulation(const scene::Effect& effect, std::uint64_t seed, std::uint32_t instance = 0,
                  const scene::Placement& placement = {});

    void step(std::uint64_t ticks);

    /// To the last tick that is over at `seconds`; starts anew if that lies in the past. Leaves out
    /// the ticks before jumpTick(); then the counters take it that nothing was rejected in them.
    void advanceTo(double seconds);

    std::uint64_t tick() const { return mTick; }  ///< ticks done
    double sinceTick() const { return mSinceTick; }  ///< ticks beyond them, [0, 1)
    std::uint32_t populationCount() const { return static_cast<std::uint32_t>(mPopulations.size()); }
    /// In order of birth.
    const std::vector<Particle>& particles(std::uint32_t population = 0) const {
        return mPopulations[population].particles;
    }
    /// Parallel to particles(); empty if the effect shows no ribbons.
    const std::vector<std::uint32_t>& strands(std::uint32_t population = 0) const {
        return mPopulations[population].strands;
    }
    const Counters& counters(std::uint32_t population = 0) const {
        return mPopulations[population].counters;
    }
    const CompiledEffect& effect(std::uint32_t population = 0) const {
        return mPopulations[population].effect;
    }
    std::uint64_t hash() const;  ///< of all populations

    /// Where its particles are now; `worldFromEffect`: where the instance is, for local space.
    ParticleFrame frame(const dmat4& worldFromEffect) const;
    /// In world space: the world counts from another point now; nothing moves.
    void rebase(const dvec3& newOrigin) { mSpace.rebase(newOrigin); }

    SimulationState state() const;
    /// Goes on from a state of the same effect.
    void restore(const SimulationState& state);

    /// As makeSpheres(), of one population, at the time of the last advanceTo().
    std::vector<scene::MediumSphere> spheres(const ParticleFrame& frame, std::uint32_t medium,
                                             std::uint32_t firstId,
                                             std::uint32_t population = 0,
                                             const std::optional<Viewer>& viewer = {}) const;

  private:
    struct Population {
        CompiledEffect effect;
        shader::InstanceParameters instance{};
        std::vector<Particle> particles;
        std::vector<std::uint32_t> strands;  // of the particles, if the effect keeps them
        Counters counters{};
        TickBirths asked{};  // of a child, by its parent in the current tick
    };

    void stepPopulation(Population& population);
    void stepSurvivors(Population& population, const shader::TickFields& fields);
    void appendBirths(Population& population, const shader::TickFields& fields,
                      const TickBirths& births);
    /// Moves a particle through the tick and lists its children.
    void follow(Population& population, const shader::TickFields& fields, bool isBirth,
                bool survives, Particle& particle);
    void restart();
    /// Leaves out ticks that nothing alive at `target` has seen.
    void jump(std::uint64_t target);

    std::vector<Population> mPopulations;
    InstanceSpace mSpace;  // of effects in world space
    std::uint64_t mTick = 0;
    double mSinceTick = 0;
};

}  // namespace brume::particles
