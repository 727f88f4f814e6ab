// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <core/error.hpp>
#include <particles/appearance_curves.hpp>
#include <particles/blackbody.hpp>

#include <algorithm>
#include <set>

namespace brume::particles {
namespace {

/// Keys at the same place are a jump; it becomes a very steep segment.
template <typename T>
scene::Curve<T> withoutJumps(scene::Curve<T> curve) {
    constexpr double kJump = 1e-5;
    for (std::size_t i = 1; i < curve.keys.size(); ++i)
        curve.keys[i].first = std::max(curve.keys[i].first, curve.keys[i - 1].first + kJump);
    return curve;
}

template <typename T>
void addPlaces(const scene::Curve<T>& curve, std::set<double>& places) {
    for (const auto& key : curve.keys) places.insert(key.first);
}

void checkPlaces(const std::set<double>& places, std::size_t allowed, const char* where,
                 const char* what) {
    if (places.size() > allowed)
        throw inputError("setting up an effect", where,
                         fmt::format("the curves have keys at {} different {}, {} allowed",
                                     places.size(), what, allowed));
}

/// A black body's colour is far from linear in its temperature, so that its curve gets places
/// between its keys too.
void addTemperaturePlaces(const scene::Curve<double>& temperature, std::set<double>& ages) {
    constexpr std::size_t kPerSegment = 6;  // chosen by us
    const auto& keys = temperature.keys;
    for (std::size_t i = 1; i < keys.size(); ++i)
        for (std::size_t part = 1; part < kPerSegment; ++part)
            ages.insert(keys[i - 1].first + (keys[i].first - keys[i - 1].first) *
                                                static_cast<double>(part) / kPerSegment);
}

void addSpeedSegments(const scene::Effect& effect, shader::AppearanceParameters& p) {
    scene::Curve<double> radius = withoutJumps(effect.radiusBySpeed);
    scene::Curve<double> density = withoutJumps(effect.densityBySpeed);
    if (radius.keys.empty()) radius.keys = {{0, 1}};
    if (density.keys.empty()) density.keys = {{0, 1}};
    std::set<double> speeds = {0};
    addPlaces(radius, speeds);
    addPlaces(density, speeds);
    checkPlaces(speeds, shader::kMaxSpeedKeys, "by speed", "speeds");
    p.radiusFactor = static_cast<float>(curveAt(radius, 0));
    p.densityFactor = static_cast<float>(curveAt(density, 0));
    for (auto next = std::next(speeds.begin()); next != speeds.end(); ++next) {
        const double a = *std::prev(next), b = *next;
        p.speedSegments[p.speedSegmentCount++] = {
            static_cast<float>(a), static_cast<float>(b - a),
            static_cast<float>((curveAt(radius, b) - curveAt(radius, a)) / (b - a)),
            static_cast<float>((curveAt(density, b) - curveAt(density, a)) / (b - a))};
    }
}

}  // namespace

shader::AppearanceParameters appearanceParameters(const scene::Effect& effect) {
    const auto radius = withoutJumps(effect.radius);
    const auto density = withoutJumps(effect.density);
    const auto tint = withoutJumps(effect.tint);
    const auto temperature = withoutJumps(effect.temperature);
    std::set<double> ages = {0};
    addPlaces(radius, ages);
    addPlaces(density, ages);
    addPlaces(tint, ages);
    addPlaces(temperature, ages);
    addTemperaturePlaces(temperature, ages);
    checkPlaces(ages, shader::kMaxAppearanceKeys, "over life", "ages");
    const auto tintAt = [&](double age) {
        const dvec3 own = curveAt(tint, age);
        return temperature.keys.empty() ? own : own * blackbodyColor(curveAt(temperature, age));
    };

    shader::AppearanceParameters p{};
    p.radius = static_cast<float>(curveAt(radius, 0));
    p.density = static_cast<float>(curveAt(density, 0));
    p.tint = vec3(tintAt(0));
    for (auto next = std::next(ages.begin()); next != ages.end(); ++next) {
        const double a = *std::prev(next), b = *next;
        p.segments[p.segmentCount++] = {
            static_cast<float>(a), static_cast<float>(b - a),
            static_cast<float>((curveAt(radius, b) - curveAt(radius, a)) / (b - a)),
            static_cast<float>((curveAt(density, b) - curveAt(density, a)) / (b - a)),
            vec3((tintAt(b) - tintAt(a)) / (b - a))};
    }
    addSpeedSegments(effect, p);
    p.thinningDistance = static_cast<float>(effect.thinning.distance);
    p.thinningLeast = static_cast<float>(effect.thinning.least);
    return p;
}

float largestTint(const scene::Effect& effect) {
    const shader::AppearanceParameters p = appearanceParameters(effect);
    // Linear between the ends of the segments.
    vec3 tint = p.tint;
    float largest = std::max({tint.x, tint.y, tint.z});
    for (std::uint32_t i = 0; i < p.segmentCount; ++i) {
        tint += p.segments[i].tintSlope * p.segments[i].width;
        largest = std::max({largest, tint.x, tint.y, tint.z});
    }
    return largest;
}

std::optional<vec3> constantTint(const scene::Effect& effect) {
    const shader::AppearanceParameters p = appearanceParameters(effect);
    for (std::uint32_t i = 0; i < p.segmentCount; ++i)
        if (p.segments[i].tintSlope != vec3(0)) return std::nullopt;
    return max(p.tint, vec3(0));
}

}  // namespace brume::particles
