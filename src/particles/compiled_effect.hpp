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

/// What the parameters of an effect need and cannot do in a shader.
struct NoiseDrift {
    dvec3 cellsPerSecond{0};  ///< of the first octave, in units of the kernel
};

/// The particles of one effect: of the effect itself, or of one of its sub-emitters.
struct CompiledEffect {
    std::uint32_t capacity = 0;
    double tickRate = 0;  ///< 1/s
    scene::Profile profile = scene::Profile::Constant;
    scene::Shadowing shadowing = scene::Shadowing::Particle;
    shader::EffectParameters parameters{};
    std::vector<shader::EmitterParameters> emitters;
    std::vector<shader::EmitterTriangle> triangles;
    std::vector<float> fieldValues;  ///< of all its grids, see shader::FieldGrid
    bool hasStrands = false;         ///< each particle's strand is kept, for ribbons
    std::vector<NoiseDrift> noiseDrifts;
    SpawnSchedule schedule;
    AliveBound aliveBound;  ///< at tick 0

    std::uint32_t parent = kNone;      ///< population whose particles these come from
    std::uint32_t subEmitter = 0;      ///< which one of the parent's
    std::uint32_t subEmitterCount = 0;
    std::vector<std::uint32_t> children;  ///< populations, by sub-emitter

    static constexpr std::uint32_t kNone = 0xffffffffu;
    bool isChild() const { return parent != kNone; }
};

/// The populations of an effect: itself, then those of its sub-emitters, each before its own.
/// Throws an input Error for modules and values that cannot be simulated.
std::vector<CompiledEffect> compileEffect(const scene::Effect& effect);

/// The effects in the order of compileEffect().
std::vector<const scene::Effect*> listPopulations(const scene::Effect& effect);

/// Equal arguments give equal particles; another seed, instance or population gives independent
/// ones.
shader::InstanceParameters instanceParameters(std::uint64_t seed, std::uint32_t instance,
                                              std::uint32_t population);

/// The tick from which a simulation that starts with nothing alive arrives at `tick` with the same
/// particles, bit by bit, as one that starts at tick 0: the longest lifetime before it. 0 if that is
/// not certain: the effect has sub-emitters, very long lifetimes, or may have run out of capacity.
std::uint64_t jumpTick(const CompiledEffect& effect, std::uint64_t tick);

/// What the modules know about a tick, the same for all instances.
shader::TickFields tickFields(const CompiledEffect& effect, std::uint64_t tick);

/// Ticks that are over at `seconds` (>= 0).
std::uint64_t ticksAt(double seconds, double tickRate);

/// How much of the next tick has passed at `seconds`, [0, 1); 0 within rounding of its start.
double tickFractionAt(double seconds, double tickRate);

/// A hash over all bits of the particles in their order, and of the tick. `previous`: hash of the
/// populations before.
std::uint64_t hashParticles(std::span<const Particle> particles, std::uint64_t tick,
                            std::uint64_t previous = 0xcbf29ce484222325u);

/// The particles as spheres for rendering, `sinceTick` ticks after `ticks` ticks: places and ages
/// move on by that. Sphere i has id firstId + birth index; radii scale with the cube root of the
/// transform's determinant. Those without a radius or density are left out.
std::vector<scene::MediumSphere> makeSpheres(const CompiledEffect& effect,
                                             std::span<const Particle> particles,
                                             std::uint64_t ticks, double sinceTick,
                                             const dmat4& worldFromEffect, std::uint32_t medium,
                                             std::uint32_t firstId);

/// Scale of lengths under a transform: the cube root of |det|.
double lengthScale(const dmat4& transform);

}  // namespace brume::particles
