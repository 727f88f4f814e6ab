// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <shaders/particles/appearance.h>
#include <core/error.hpp>
#include <particles/compiled_effect.hpp>
#include <particles/modules/module.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace brume::particles {
namespace {

void check(bool isAllowed, const std::string& where, const std::string& problem) {
    if (!isAllowed) throw inputError("setting up an effect", where, problem);
}

void checkRange(double value, double lo, double hi, const std::string& where,
                const std::string& name) {
    check(value >= lo && value <= hi, where,
          fmt::format("{} is {}, {} to {} allowed", name, value, lo, hi));
}

void checkInterval(const dvec2& range, double lo, double hi, const std::string& where,
                   const std::string& name) {
    checkRange(range.x, lo, hi, where, name);
    checkRange(range.y, lo, hi, where, name);
    check(range.x <= range.y, where,
          fmt::format("{} runs from {} down to {}, [low, high] allowed", name, range.x, range.y));
}

void checkEmitter(const scene::Emitter& emitter, const std::string& where) {
    checkRange(emitter.rate, 0, 1e9, where, "'rate'");
    check(emitter.duration >= 0, where,
          fmt::format("'duration' is {}, >= 0 allowed", emitter.duration));
    for (const scene::Burst& burst : emitter.bursts)
        checkRange(burst.time, 0, 1e9, where, "'time' of a burst");
    checkInterval(emitter.lifetime, 0, 1e9, where, "'lifetime'");
    checkInterval(emitter.speed, -1e6, 1e6, where, "'speed'");
    checkRange(emitter.radius, 0, 1e6, where, "'radius'");
    checkRange(emitter.spread, 0, kPi * (1 + 1e-12), where, "'spread'");
    for (int axis = 0; axis < 3; ++axis) {
        checkRange(emitter.size[axis], 0, 1e6, where, "'size'");
        checkRange(emitter.position[axis], -1e9, 1e9, where, "'position'");
        checkRange(emitter.direction[axis], -1e9, 1e9, where, "'direction'");
    }
    check(glm::length(emitter.direction) > 0, where, "'direction' is zero, a direction allowed");
}

template <typename T>
void checkCurve(const scene::Curve<T>& curve, const std::string& name) {
    check(!curve.keys.empty(), name, "the curve has no keys, at least one allowed");
    for (std::size_t i = 0; i < curve.keys.size(); ++i) {
        checkRange(curve.keys[i].first, 0, 1, name, "the age of a key");
        check(i == 0 || curve.keys[i - 1].first <= curve.keys[i].first, name,
              "the keys are not sorted by age, rising ages allowed");
    }
}

void checkEffect(const scene::Effect& effect) {
    constexpr std::uint32_t kMaxCapacity = 1u << 26u;
    check(effect.capacity >= 1 && effect.capacity <= kMaxCapacity, "",
          fmt::format("'capacity' is {}, 1 to {} allowed", effect.capacity, kMaxCapacity));
    checkRange(effect.tickRate, 1, 1e5, "", "'tickRate'");
    for (std::size_t i = 0; i < effect.emitters.size(); ++i)
        checkEmitter(effect.emitters[i], fmt::format("emitter {}", i));
    checkCurve(effect.radius, "radius over life");
    checkCurve(effect.density, "density over life");
    checkCurve(effect.tint, "tint over life");
}

shader::EmitterParameters emitterParameters(const scene::Emitter& emitter, double tickRate) {
    const dvec3 axis = glm::normalize(emitter.direction);
    // Any orthonormal frame; the axis' smallest component gives the safest cross product.
    const dvec3 a = glm::abs(axis);
    const dvec3 helper = a.x <= a.y && a.x <= a.z ? dvec3(1, 0, 0)
                         : a.y <= a.z             ? dvec3(0, 1, 0)
                                                  : dvec3(0, 0, 1);
    const dvec3 tangent = glm::normalize(glm::cross(helper, axis));
    const double halfSpread = std::sin(0.5 * std::min(emitter.spread, kPi));

    shader::EmitterParameters p{};
    p.position = vec3(emitter.position);
    p.shape = static_cast<std::uint32_t>(emitter.shape);
    p.size = vec3(emitter.size);
    p.radius = static_cast<float>(emitter.radius);
    p.axis = vec3(axis);
    p.coneHeight = static_cast<float>(2 * halfSpread * halfSpread);  // 1 - cos(spread)
    p.tangent = vec3(tangent);
    p.bitangent = vec3(glm::cross(axis, tangent));
    p.speedLow = static_cast<float>(emitter.speed.x);
    p.speedRange = static_cast<float>(emitter.speed.y - emitter.speed.x);
    p.lifetimeLowTicks = static_cast<float>(emitter.lifetime.x * tickRate);
    p.lifetimeRangeTicks = static_cast<float>((emitter.lifetime.y - emitter.lifetime.x) * tickRate);
    return p;
}

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
    step.dragHalvings = y > 1 ? static_cast<std::uint32_t>(std::ceil(std::log2(y) + 1e-6)) : 0;
    return step;
}

template <typename T>
T curveAt(const scene::Curve<T>& curve, double age) {
    const auto& keys = curve.keys;
    if (age <= keys.front().first) return keys.front().second;
    for (std::size_t i = 1; i < keys.size(); ++i) {
        if (age > keys[i].first) continue;
        const double part = (age - keys[i - 1].first) / (keys[i].first - keys[i - 1].first);
        return keys[i - 1].second + (keys[i].second - keys[i - 1].second) * part;
    }
    return keys.back().second;
}

/// Keys at the same age are a jump; it becomes a very steep segment.
template <typename T>
scene::Curve<T> withoutJumps(scene::Curve<T> curve) {
    constexpr double kJump = 1e-5;
    for (std::size_t i = 1; i < curve.keys.size(); ++i)
        curve.keys[i].first = std::max(curve.keys[i].first, curve.keys[i - 1].first + kJump);
    return curve;
}

/// One list of segments between the ages at which any of the three curves has a key.
shader::AppearanceParameters appearanceParameters(const scene::Effect& effect) {
    const auto radius = withoutJumps(effect.radius);
    const auto density = withoutJumps(effect.density);
    const auto tint = withoutJumps(effect.tint);
    std::set<double> ages;
    for (const auto& key : radius.keys) ages.insert(key.first);
    for (const auto& key : density.keys) ages.insert(key.first);
    for (const auto& key : tint.keys) ages.insert(key.first);
    check(ages.size() <= shader::kMaxAppearanceKeys, "over life",
          fmt::format("the curves have keys at {} different ages, {} allowed", ages.size(),
                      shader::kMaxAppearanceKeys));

    shader::AppearanceParameters p{};
    p.radius = static_cast<float>(curveAt(radius, 0));
    p.density = static_cast<float>(curveAt(density, 0));
    p.tint = vec3(curveAt(tint, 0));
    for (auto next = std::next(ages.begin()); next != ages.end(); ++next) {
        const double a = *std::prev(next);
        const double b = *next;
        shader::AppearanceSegment& segment = p.segments[p.segmentCount++];
        segment.start = static_cast<float>(a);
        segment.width = static_cast<float>(b - a);
        segment.radiusSlope =
            static_cast<float>((curveAt(radius, b) - curveAt(radius, a)) / (b - a));
        segment.densitySlope =
            static_cast<float>((curveAt(density, b) - curveAt(density, a)) / (b - a));
        segment.tintSlope = vec3((curveAt(tint, b) - curveAt(tint, a)) / (b - a));
    }
    return p;
}

double longestLifetime(const scene::Effect& effect) {
    double longest = 0;
    for (const scene::Emitter& emitter : effect.emitters)
        longest = std::max(longest, emitter.lifetime.y);
    return longest;
}

}  // namespace

CompiledEffect compileEffect(const scene::Effect& effect, std::uint64_t seed,
                             std::uint32_t instance) {
    checkEffect(effect);
    CompiledEffect compiled{
        .capacity = effect.capacity,
        .tickRate = effect.tickRate,
        .profile = effect.smoothProfile ? scene::Profile::Smooth : scene::Profile::Constant,
        .parameters = {},
        .emitters = {},
        .schedule = SpawnSchedule(effect),
        .aliveBound = AliveBound(effect.capacity, longestLifetime(effect) * effect.tickRate)};
    compiled.parameters.random = {static_cast<std::uint32_t>(seed),
                                  static_cast<std::uint32_t>(seed >> 32u), instance};
    ModuleSums sums;
    sums.seed = seed;
    sums.parameters = &compiled.parameters;
    addModules(effect.modules, sums);
    compiled.parameters.step = stepParameters(sums, effect.tickRate);
    compiled.parameters.appearance = appearanceParameters(effect);
    for (const scene::Emitter& emitter : effect.emitters)
        compiled.emitters.push_back(emitterParameters(emitter, effect.tickRate));
    return compiled;
}

std::uint64_t ticksAt(double seconds, double tickRate) {
    // Frame times such as 1/24 s are not exact, and a tick must not be missed by that.
    return seconds > 0 ? static_cast<std::uint64_t>(std::floor(seconds * tickRate + 1e-6)) : 0;
}

std::uint64_t hashParticles(std::span<const Particle> particles, std::uint64_t tick) {
    // FNV-1a over 32-bit words (Fowler, Noll, Vo).
    std::uint64_t hash = 0xcbf29ce484222325u;
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

double lengthScale(const dmat4& transform) {
    return std::cbrt(std::fabs(glm::determinant(dmat3(transform))));
}

std::vector<scene::MediumSphere> makeSpheres(const CompiledEffect& effect,
                                             std::span<const Particle> particles,
                                             std::uint64_t ticks, const dmat4& worldFromEffect,
                                             std::uint32_t medium, std::uint32_t firstId) {
    std::vector<scene::MediumSphere> spheres;
    spheres.reserve(particles.size());
    const auto scale = static_cast<float>(lengthScale(worldFromEffect));
    const auto lastTick = static_cast<std::uint32_t>(ticks - 1);
    for (const Particle& particle : particles) {
        if (particle.life.lifetimeTicks < 0) continue;
        const shader::Appearance look = shader::evaluateAppearance(
            effect.parameters, shader::normalisedAge(particle.life, lastTick));
        if (!(look.radius > 0 && look.density > 0)) continue;
        spheres.push_back({.center = transformPoint(worldFromEffect, dvec3(particle.position)),
                           .radius = look.radius * scale,
                           .density = look.density,
                           .tint = look.tint,
                           .medium = medium,
                           .id = firstId + particle.birthIndex,
                           .profile = effect.profile});
    }
    return spheres;
}

}  // namespace brume::particles
