// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <shaders/particles/appearance.h>
#include <shaders/particles/spawn.h>
#include <core/error.hpp>
#include <particles/appearance_curves.hpp>
#include <particles/compiled_effect.hpp>
#include <particles/compiled_emitter.hpp>
#include <particles/effect_check.hpp>
#include <particles/fields.hpp>
#include <particles/modules/module.hpp>

#include <algorithm>
#include <cmath>

namespace brume::particles {
namespace {

constexpr std::uint32_t kMaxPopulations = 16;

/// The factors of the exact step over one tick, in double precision (shaders/particles/step.h).
shader::StepParameters stepParameters(const ModuleSums& sums, double tickRate) {
    const double h = 1 / tickRate;
    const double k = sums.dragRate;
    const double y = k * h;
    double loss = 0, phi1 = 1, phi2 = 0.5;
    if (y > 1e-4) {
        loss = -std::expm1(-y);
        phi1 = loss / y;
        phi2 = (1 - phi1) / y;
    } else {
        // Differences of nearly equal numbers above; three terms of the series are exact here.
        phi2 = 0.5 - y / 6 + y * y / 24;
        phi1 = 1 - y * phi2;
        loss = y * phi1;
    }
    shader::StepParameters step{};
    step.acceleration = vec3(sums.acceleration);
    step.tickSeconds = static_cast<float>(h);
    step.wind = k > 0 ? vec3(sums.dragRateTimesWind / k) : vec3(0);
    step.dragPerTick = static_cast<float>(y);
    step.loss = static_cast<float>(loss);
    step.velocityGain = static_cast<float>(h * phi1);
    step.positionGain = static_cast<float>(h * h * phi2);
    // A particle at rest on a surface gains at most |a| h per tick.
    step.restSpeed = static_cast<float>(2 * glm::length(sums.acceleration) * h);
    step.ticksPerSecond = static_cast<float>(tickRate);
    step.dragHalvings = y > 1 ? static_cast<std::uint32_t>(std::ceil(std::log2(y) + 1e-6)) : 0;
    return step;
}

double longestLifetime(const scene::Effect& effect) {
    double longest = 0;
    for (const scene::Emitter& emitter : effect.emitters)
        longest = std::max(longest, emitter.lifetime.y);
    return longest;
}

shader::SubEmitter subEmitterParameters(const scene::SubEmitter& sub, std::uint32_t index,
                                        double tickRate) {
    shader::SubEmitter p{};
    p.trigger = static_cast<std::uint32_t>(sub.trigger);
    p.index = index;
    p.countLow = static_cast<float>(sub.count.x);
    p.countRange = static_cast<float>(sub.count.y - sub.count.x);
    if (sub.trigger == scene::SubEmitterTrigger::Way) {
        p.ratePerTick = static_cast<float>(sub.rate / tickRate);
        p.ticksPerBirth = static_cast<float>(tickRate / sub.rate);
    }
    return p;
}

CompiledEffect compileOne(const scene::Effect& effect, bool isChild) {
    checkEffect(effect, isChild);
    CompiledEffect compiled{
        .capacity = effect.capacity,
        .tickRate = effect.tickRate,
        .profile = effect.smoothProfile ? scene::Profile::Smooth : scene::Profile::Constant,
        .shadowing = effect.shadowing,
        .schedule = SpawnSchedule(effect),
        .aliveBound = AliveBound(effect.capacity, longestLifetime(effect) * effect.tickRate)};
    shader::EffectParameters& p = compiled.parameters;
    FieldPacker packer(compiled.fieldValues);
    ModuleSums sums;
    sums.parameters = &p;
    sums.effect = &effect;
    sums.fields = &packer;
    addModules(effect.modules, sums);
    compiled.depthCollider = sums.depthCollider;
    compiled.depthColliderWhere = sums.depthColliderWhere;
    p.step = stepParameters(sums, effect.tickRate);
    p.isWorld = effect.isWorldSpace;
    p.appearance = appearanceParameters(effect);
    for (std::size_t i = 0; i < sums.noiseDrifts.size(); ++i)
        compiled.noiseDrifts.push_back({-sums.noiseDrifts[i] * double{p.curlNoise[i].frequency}});
    for (const scene::Emitter& emitter : effect.emitters)
        addEmitter(effect, emitter, packer, compiled);
    compiled.hasStrands =
        effect.surface && effect.surface->type == scene::SurfaceType::Ribbon;
    for (const scene::SubEmitter& sub : effect.subEmitters) {
        p.subEmitters[compiled.subEmitterCount] =
            subEmitterParameters(sub, compiled.subEmitterCount, effect.tickRate);
        ++compiled.subEmitterCount;
    }
    return compiled;
}

void addPopulations(const scene::Effect& effect, std::uint32_t parent, std::uint32_t sub,
                    std::vector<CompiledEffect>& all) {
    if (all.size() == kMaxPopulations)
        throw inputError("setting up an effect", "",
                         fmt::format("the effect has more than {} effects below each other, {} "
                                     "allowed",
                                     kMaxPopulations, kMaxPopulations));
    const auto index = static_cast<std::uint32_t>(all.size());
    all.push_back(compileOne(effect, parent != CompiledEffect::kNone));
    all[index].parent = parent;
    if (parent != CompiledEffect::kNone) {
        if (effect.isWorldSpace && !all[parent].isWorldSpace())
            throw inputError("setting up an effect", "",
                             "'space' of a sub-emitter's effect is world below a parent in local "
                             "space, that of its parent allowed");
        all[index].parameters.isWorld = all[parent].parameters.isWorld;
    }
    all[index].subEmitter = sub;
    for (std::uint32_t i = 0; i < effect.subEmitters.size(); ++i) {
        all[index].children.push_back(static_cast<std::uint32_t>(all.size()));
        addPopulations(*effect.subEmitters[i].effect, index, i, all);
    }
}

void listPopulations(const scene::Effect& effect, std::vector<const scene::Effect*>& all) {
    all.push_back(&effect);
    for (const scene::SubEmitter& sub : effect.subEmitters) listPopulations(*sub.effect, all);
}

}  // namespace

std::vector<CompiledEffect> compileEffect(const scene::Effect& effect) {
    std::vector<CompiledEffect> all;
    addPopulations(effect, CompiledEffect::kNone, 0, all);
    return all;
}

void requireReplayable(std::span<const CompiledEffect> populations, const char* doing) {
    for (const CompiledEffect& population : populations)
        if (population.depthCollider)
            throw inputError(doing, population.depthColliderWhere,
                             "module 'collide_depth' is not replayable, it needs the picture of a "
                             "device: allowed in 'render' and 'view' with a method of the GPU");
}

std::vector<const scene::Effect*> listPopulations(const scene::Effect& effect) {
    std::vector<const scene::Effect*> all;
    listPopulations(effect, all);
    return all;
}

shader::InstanceParameters instanceParameters(std::uint64_t seed, std::uint32_t instance,
                                              std::uint32_t population) {
    shader::InstanceParameters p{};
    p.random = {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32u),
                instance};
    if (population > 0) {
        // A key of its own for each population, out of reach of the counters of births.
        const shader::uvec4 words =
            shader::philox4x32(shader::uvec4(population, 0, 0, 1),
                               shader::uvec2(p.random.seedLow, p.random.seedHigh));
        p.random.seedLow = words.x;
        p.random.seedHigh = words.y;
    }
    p.axisX = vec3(1, 0, 0);
    p.axisY = vec3(0, 1, 0);
    p.axisZ = vec3(0, 0, 1);
    p.noiseSeed = shader::pcg3d(shader::uvec3(p.random.seedLow, p.random.seedHigh, 0)).x;
    return p;
}

std::uint64_t jumpTick(const CompiledEffect& effect, std::uint64_t tick, std::uint64_t from) {
    const std::uint64_t window = effect.aliveBound.windowTicks();
    // The indices of children count all that were asked for since tick 0.
    if (effect.subEmitterCount > 0 || window == 0 || tick <= 2 * window) return 0;
    // What was born within a window has met nobody but what was born in the window before that.
    const std::uint64_t start = tick - window;
    if (start <= from) return 0;
    std::uint64_t births = 0;
    for (std::uint64_t t = start - window; t < tick; ++t) {
        const TickBirths now = effect.schedule.at(t);
        births += now.count;
        if (t >= start) births -= effect.schedule.at(t - window).count;
        if (now.overflow > 0 || births > effect.capacity) return 0;
    }
    return start;
}

shader::TickFields tickFields(const CompiledEffect& effect, std::uint64_t tick,
                              const dvec3& shift) {
    shader::TickFields fields{};
    fields.shift = vec3(shift);
    const double seconds = (static_cast<double>(tick) + 0.5) / effect.tickRate;
    for (std::size_t i = 0; i < effect.noiseDrifts.size(); ++i) {
        const dvec3 way = effect.noiseDrifts[i].cellsPerSecond * seconds +
                          shift * double{effect.parameters.curlNoise[i].frequency};
        const dvec3 cells = glm::floor(way + (way.x + way.y + way.z) / 3);
        const dvec3 rest = way - (cells - (cells.x + cells.y + cells.z) / 6);
        for (int axis = 0; axis < 3; ++axis)
            fields.curlNoise[i].cells[axis] =
                static_cast<std::uint32_t>(static_cast<std::int64_t>(cells[axis]));
        fields.curlNoise[i].rest = vec3(rest);
    }
    return fields;
}

std::uint64_t ticksAt(double seconds, double tickRate) {
    // Frame times such as 1/24 s are not exact, and a tick must not be missed by that.
    return seconds > 0 ? static_cast<std::uint64_t>(std::floor(seconds * tickRate + 1e-6)) : 0;
}

double tickFractionAt(double seconds, double tickRate) {
    const double fraction =
        seconds * tickRate - static_cast<double>(ticksAt(seconds, tickRate));
    return fraction > 2e-6 ? std::min(fraction, 1 - 1e-6) : 0;
}

std::uint64_t hashParticles(std::span<const Particle> particles, std::uint64_t tick,
                            std::uint64_t previous) {
    // FNV-1a over 32-bit words (Fowler, Noll, Vo).
    std::uint64_t hash = previous;
    const auto add = [&](std::uint32_t word) { hash = (hash ^ word) * 0x100000001b3u; };
    add(static_cast<std::uint32_t>(tick));
    add(static_cast<std::uint32_t>(tick >> 32u));
    for (const Particle& p : particles) {
        for (int axis = 0; axis < 3; ++axis) add(std::bit_cast<std::uint32_t>(p.position[axis]));
        for (int axis = 0; axis < 3; ++axis) add(std::bit_cast<std::uint32_t>(p.velocity[axis]));
        add(p.life.birthTick);
        add(std::bit_cast<std::uint32_t>(p.life.birthRemaining));
        add(std::bit_cast<std::uint32_t>(p.life.lifetimeTicks));
        add(p.birthIndex);
    }
    return hash;
}

std::vector<scene::MediumSphere> makeSpheres(const CompiledEffect& effect,
                                             std::span<const Particle> particles,
                                             std::uint64_t ticks, double sinceTick,
                                             const ParticleFrame& frame, std::uint32_t medium,
                                             std::uint32_t firstId,
                                             const shader::RandomStream& random,
                                             const std::optional<Viewer>& viewer) {
    std::vector<scene::MediumSphere> spheres;
    spheres.reserve(particles.size());
    const auto scale = static_cast<float>(frame.radiusScale);
    const auto lastTick = static_cast<std::uint32_t>(ticks - 1);
    for (const Particle& particle : particles) {
        const auto since = static_cast<float>(sinceTick);
        if (!shader::isShownAt(particle.life, lastTick, since)) continue;
        shader::Appearance look = shader::evaluateAppearance(
            effect.parameters, shader::normalisedAge(particle.life, lastTick, since),
            glm::length(particle.velocity));
        const dvec3 place =
            dvec3(particle.position) + dvec3(particle.velocity) * (sinceTick / effect.tickRate);
        const dvec3 center = transformPoint(frame.worldFromParticles, place);
        if (viewer && viewer->hasDistance && effect.parameters.appearance.thinningDistance > 0)
            look = shader::thinOut(effect.parameters, look,
                                   static_cast<float>(glm::length(center - viewer->position)),
                                   shader::thinningRank(random, particle.birthIndex));
        if (!(look.radius > 0 && look.density > 0)) continue;
        spheres.push_back({.center = center,
                           .radius = look.radius * scale,
                           .density = look.density,
                           .tint = look.tint,
                           .medium = medium,
                           .id = firstId + particle.birthIndex,
                           .profile = effect.profile,
                           .shadowing = effect.shadowing});
    }
    return spheres;
}

}  // namespace brume::particles
