// SPDX-License-Identifier: Apache-2.0
// An effect made ready to simulate: checked, and turned into the numbers that both simulators
// compute with.
#pragma once

#include <shaders/particles/effect.h>
#include <particles/spawn_schedule.hpp>
#include <scene/effect.hpp>
#include <scene/medium_sphere.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace brume::particles {

using shader::Particle;
using Counters = shader::ParticleCounters;

struct CompiledEffect {
    std::uint32_t capacity = 0;
    double tickRate = 0;  ///< 1/s
    scene::Profile profile = scene::Profile::Constant;
    shader::EffectParameters parameters{};
    std::vector<shader::EmitterParameters> emitters;
    SpawnSchedule schedule;  ///< at tick 0
    AliveBound aliveBound;   ///< at tick 0
};

/// Equal arguments give equal particles; another seed or instance gives independent ones. Throws an
/// input Error for modules and values that cannot be simulated.
CompiledEffect compileEffect(const scene::Effect& effect, std::uint64_t seed,
                             std::uint32_t instance);

/// Ticks that are over at `seconds` (>= 0).
std::uint64_t ticksAt(double seconds, double tickRate);

/// A hash over all bits of the particles in their order, and of the tick.
std::uint64_t hashParticles(std::span<const Particle> particles, std::uint64_t tick);

/// The particles as spheres for rendering, after `ticks` ticks. Sphere i has id firstId + birth
/// index; radii scale with the cube root of the transform's determinant. Those without a radius or
/// density are left out.
std::vector<scene::MediumSphere> makeSpheres(const CompiledEffect& effect,
                                             std::span<const Particle> particles,
                                             std::uint64_t ticks, const dmat4& worldFromEffect,
                                             std::uint32_t medium, std::uint32_t firstId);

/// Scale of lengths under a transform: the cube root of |det|.
double lengthScale(const dmat4& transform);

}  // namespace brume::particles
