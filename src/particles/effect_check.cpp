// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <shaders/particles/effect.h>
#include <core/error.hpp>
#include <particles/effect_check.hpp>

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

void checkBurst(const scene::Burst& burst, const std::string& where) {
    checkRange(burst.time, 0, 1e6, where, "'time' of a burst");
    check(burst.repeat >= 1, where, "'repeat' of a burst is 0, 1 and more allowed");
    if (burst.repeat > 1) checkRange(burst.interval, 1e-4, 1e6, where, "'interval' of a burst");
}

template <typename T>
void checkCurve(const scene::Curve<T>& curve, double last, const std::string& name,
                const std::string& what) {
    for (std::size_t i = 0; i < curve.keys.size(); ++i) {
        checkRange(curve.keys[i].first, 0, last, name, "the " + what + " of a key");
        check(i == 0 || curve.keys[i - 1].first <= curve.keys[i].first, name,
              fmt::format("the keys are not sorted by {}, rising ones allowed", what));
    }
}

template <typename T>
void checkLifeCurve(const scene::Curve<T>& curve, const std::string& name) {
    check(!curve.keys.empty(), name, "the curve has no keys, at least one allowed");
    checkCurve(curve, 1, name, "age");
}

void checkShape(const scene::Emitter& emitter, const std::string& where) {
    checkRange(emitter.radius, 0, 1e6, where, "'radius'");
    checkRange(emitter.innerRadius, 0, emitter.radius, where, "'innerRadius'");
    checkRange(emitter.height, 1e-6, 1e6, where, "'height'");
    for (int axis = 0; axis < 3; ++axis) {
        if (emitter.shape == scene::EmitterShape::Box)
            checkRange(emitter.size[axis], 0, 1e6, where, "'size'");
        checkRange(emitter.size[axis], -1e6, 1e6, where, "'size'");
        checkRange(emitter.position[axis], -1e9, 1e9, where, "'position'");
        checkRange(emitter.direction[axis], -1e9, 1e9, where, "'direction'");
        checkRange(emitter.normal[axis], -1e9, 1e9, where, "'normal'");
    }
    check(glm::length(emitter.direction) > 0, where, "'direction' is zero, a direction allowed");
    check(glm::length(emitter.normal) > 0, where, "'normal' is zero, a direction allowed");
    if (emitter.shape == scene::EmitterShape::Mesh)
        check(emitter.triangles && !emitter.triangles->empty(), where,
              "the mesh has no triangles, at least one allowed");
}

void checkEmitter(const scene::Emitter& emitter, const std::string& where) {
    checkRange(emitter.rate, 0, 1e9, where, "'rate'");
    checkRange(emitter.delay, 0, 1e6, where, "'delay'");
    check(emitter.duration >= 0, where,
          fmt::format("'duration' is {}, >= 0 allowed", emitter.duration));
    for (const scene::Burst& burst : emitter.bursts) checkBurst(burst, where);
    checkInterval(emitter.lifetime, 0, 1e9, where, "'lifetime'");
    checkInterval(emitter.speed, -1e6, 1e6, where, "'speed'");
    checkRange(emitter.spread, 0, kPi * (1 + 1e-12), where, "'spread'");
    checkRange(emitter.inherit, -100, 100, where, "'inherit'");
    checkShape(emitter, where);
    for (std::size_t i = 0; i < emitter.path.size(); ++i) {
        checkRange(emitter.path[i].first, 0, 1e6, where, "a time of 'path'");
        check(i == 0 || emitter.path[i - 1].first < emitter.path[i].first, where,
              "the times of 'path' do not rise, rising times allowed");
        for (int axis = 0; axis < 3; ++axis)
            checkRange(emitter.path[i].second[axis], -1e6, 1e6, where, "a place of 'path'");
    }
}

void checkChild(const scene::Effect& effect) {
    check(effect.emitters.size() == 1, "",
          fmt::format("the effect of a sub-emitter has {} emitters, 1 allowed",
                      effect.emitters.size()));
    const scene::Emitter& emitter = effect.emitters[0];
    check(emitter.rate == 0 && emitter.bursts.empty() && emitter.path.empty(), "emitter 0",
          "has 'rate', 'bursts' or 'path', none allowed in the effect of a sub-emitter");
}

void checkSubEmitter(const scene::SubEmitter& sub, const scene::Effect& parent) {
    check(sub.effect != nullptr, sub.where, "the sub-emitter has no effect, one allowed");
    checkInterval(sub.count, 0, shader::kMaxChildrenPerTick - 1, sub.where,
                  "'count' of a sub-emitter");
    if (sub.trigger == scene::SubEmitterTrigger::Way)
        checkRange(sub.rate, 1e-6, 0.5 * shader::kMaxChildrenPerTick * parent.tickRate, sub.where,
                   "'rate' of a sub-emitter");
    check(sub.effect->tickRate == parent.tickRate, sub.where,
          fmt::format("the sub-emitter's effect has 'tickRate' {}, that of its parent, {}, allowed",
                      sub.effect->tickRate, parent.tickRate));
}

}  // namespace

void checkEffect(const scene::Effect& effect, bool isChild) {
    constexpr std::uint32_t kMaxCapacity = 1u << 26u;
    check((effect.capacity >= 1 || effect.uncutCapacity > 0) && effect.capacity <= kMaxCapacity, "",
          fmt::format("'capacity' is {}, 1 to {} allowed", effect.capacity, kMaxCapacity));
    checkRange(effect.tickRate, 1, 1e5, "", "'tickRate'");
    checkRange(effect.thinning.distance, 0, 1e9, "", "'distance' of 'thinning'");
    checkRange(effect.thinning.least, 1e-4, 1, "", "'least' of 'thinning'");
    for (std::size_t i = 0; i < effect.emitters.size(); ++i)
        checkEmitter(effect.emitters[i], fmt::format("emitter {}", i));
    checkLifeCurve(effect.radius, "radius over life");
    checkLifeCurve(effect.density, "density over life");
    checkLifeCurve(effect.tint, "tint over life");
    checkCurve(effect.temperature, 1, "temperature over life", "age");
    for (const auto& key : effect.temperature.keys)
        checkRange(key.second, 100, 1e5, "temperature over life", "a temperature");
    checkCurve(effect.radiusBySpeed, 1e6, "radius by speed", "speed");
    checkCurve(effect.densityBySpeed, 1e6, "density by speed", "speed");
    if (isChild) checkChild(effect);
    check(effect.subEmitters.size() <= shader::kMaxSubEmitters, "",
          fmt::format("the effect has {} sub-emitters, {} allowed", effect.subEmitters.size(),
                      shader::kMaxSubEmitters));
    for (const scene::SubEmitter& sub : effect.subEmitters) checkSubEmitter(sub, effect);
}

}  // namespace brume::particles
