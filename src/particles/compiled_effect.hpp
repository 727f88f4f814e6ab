// SPDX-License-Identifier: Apache-2.0
// An effect made ready to simulate: checked, and turned into the numbers that both simulators
// compute with.
#pragma once

#include <shaders/particles/effect.h>
#include <shaders/particles/modules/collide_depth.h>
#include <particles/instance_space.hpp>
#include <particles/spawn_schedule.hpp>
#include <scene/effect.hpp>
#include <scene/medium_sphere.hpp>

#include <cstdint>
#include <optional>
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
    std::optional<shader::DepthCollider> depthCollider;  ///< not replayable
    std::string depthColliderWhere;                      ///< in the effect's file
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
    bool isWorldSpace() const { return parameters.isWorld != 0; }
};

/// The populations of an effect: itself, then those of its sub-emitters, each before its own.
/// Throws an input Error for modules and values that cannot be simulated.
std::vector<CompiledEffect> compileEffect(const scene::Effect& effect);

/// Throws an input Error at a module whose particles depend on more than effect, seed and tick. `doing`:
/// what asks for that.
void requireReplayable(std::span<const CompiledEffect> populations, const char* doing);

/// The effects in the order of compileEffect().
std::vector<const scene::Effect*> listPopulations(const scene::Effect& effect);

/// Equal arguments give equal particles; another seed, instance or population gives independent
/// ones.
shader::InstanceParameters instanceParameters(std::uint64_t seed, std::uint32_t instance,
                                              std::uint32_t population);

/// The tick from which a simulation that starts with nothing alive arrives at `tick` with the same
/// particles, bit by bit, as one that starts at tick 0: the longest lifetime before it. 0 if that is
/// not certain: the effect has sub-emitters, very long lifetimes, or may have run out of capacity;
/// and if it is not later than `from`, where a simulation is already.
std::uint64_t jumpTick(const CompiledEffect& effect, std::uint64_t tick, std::uint64_t from = 0);

/// What the modules know about a tick, the same for all instances in local space. `shift`: as
/// InstanceSpace::shiftAt().
shader::TickFields tickFields(const CompiledEffect& effect, std::uint64_t tick,
                              const dvec3& shift = dvec3(0));

/// Ticks that are over at `seconds` (>= 0).
std::uint64_t ticksAt(double seconds, double tickRate);

/// How much of the next tick has passed at `seconds`, [0, 1); 0 within rounding of its start.
double tickFractionAt(double seconds, double tickRate);

/// A hash over all bits of the particles in their order, and of the tick. `previous`: hash of the
/// populations before.
std::uint64_t hashParticles(std::span<const Particle> particles, std::uint64_t tick,
                            std::uint64_t previous = 0xcbf29ce484222325u);

/// The particles as spheres for rendering, `sinceTick` ticks after `ticks` ticks: places and ages
/// move on by that. Sphere i has id firstId + birth index; `random` of instanceParameters() and the
/// viewer decide which are thinned out. Those without a radius or density are
/// left out.
std::vector<scene::MediumSphere> makeSpheres(const CompiledEffect& effect,
                                             std::span<const Particle> particles,
                                             std::uint64_t ticks, double sinceTick,
                                             const ParticleFrame& frame, std::uint32_t medium,
                                             std::uint32_t firstId,
                                             const shader::RandomStream& random = {},
                                             const std::optional<Viewer>& viewer = {});

}  // namespace brume::particles
