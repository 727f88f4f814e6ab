// SPDX-License-Identifier: Apache-2.0
// An effect's curves as the segments that shaders/particles/appearance.h evaluates.
#pragma once

#include <shaders/particles/effect.h>
#include <scene/effect.hpp>

#include <optional>

namespace brume::particles {

/// Throws an input Error if the curves have too many keys.
shader::AppearanceParameters appearanceParameters(const scene::Effect& effect);

/// The largest component that the tint ever has, that of the temperature included.
float largestTint(const scene::Effect& effect);

/// The tint of all particles, if it is the same at every age.
std::optional<vec3> constantTint(const scene::Effect& effect);

/// The value of a curve with at least one key.
template <typename T>
T curveAt(const scene::Curve<T>& curve, double x) {
    const auto& keys = curve.keys;
    if (x <= keys.front().first) return keys.front().second;
    for (std::size_t i = 1; i < keys.size(); ++i) {
        if (x > keys[i].first) continue;
        const double part = (x - keys[i - 1].first) / (keys[i].first - keys[i - 1].first);
        return keys[i - 1].second + (keys[i].second - keys[i - 1].second) * part;
    }
    return keys.back().second;
}

}  // namespace brume::particles
