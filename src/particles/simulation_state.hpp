// SPDX-License-Identifier: Apache-2.0
// The whole state of an instance of an effect, and its way to a file and back.
#pragma once

#include <filesystem>
#include <particles/compiled_effect.hpp>

namespace brume::particles {

struct SimulationState {
    std::uint64_t tick = 0;                          ///< ticks done
    std::vector<std::vector<Particle>> populations;  ///< each in order of birth
    /// By population, parallel to its particles: which particles a ribbon connects. Empty where the
    /// effect shows none.
    std::vector<std::vector<std::uint32_t>> strands;
    std::vector<Counters> counters;                  ///< by population
    std::uint64_t hash() const;                      ///< of everything but the counters
};

/// What a state belongs to: going on from it with another effect or seed would be another motion.
struct CheckpointKey {
    std::uint64_t effect = 0;  ///< fingerprintOf()
    std::uint64_t seed = 0;
    std::uint32_t instance = 0;
};

/// A hash of all that decides how an effect moves (not of how it looks).
std::uint64_t fingerprintOf(const std::vector<CompiledEffect>& populations);

/// The same with the way of the instance, which decides in world space.
std::uint64_t fingerprintOf(const std::vector<CompiledEffect>& populations,
                            const scene::Placement& placement);

/// Writes a file whole or not at all: 40 bytes per particle. Throws a failure Error.
void writeCheckpoint(const std::filesystem::path& file, const CheckpointKey& key,
                     const SimulationState& state);

/// Throws an input Error if the file is damaged or belongs to another effect, seed or instance.
/// `populations`: of the effect, for their number and capacities.
SimulationState readCheckpoint(const std::filesystem::path& file, const CheckpointKey& key,
                               const std::vector<CompiledEffect>& populations);

}  // namespace brume::particles
