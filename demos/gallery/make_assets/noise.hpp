// SPDX-License-Identifier: Apache-2.0
// Noise to sculpt with: gradient noise, its sums, and cells. Deterministic, the same everywhere.
#pragma once

#include <core/math.hpp>

#include <cmath>
#include <cstdint>

namespace brume::gallery {

/// A well mixed function of a lattice point.
inline std::uint32_t hashOf(ivec3 p, std::uint32_t seed) {
    std::uint32_t h = seed * 0x9e3779b9u;
    for (const int c : {p.x, p.y, p.z}) {
        h = (h ^ static_cast<std::uint32_t>(c)) * 0x85ebca6bu;
        h ^= h >> 15;
    }
    h *= 0xc2b2ae35u;
    return h ^ (h >> 16);
}

/// In [0, 1).
inline float uniformOf(ivec3 p, std::uint32_t seed) {
    return static_cast<float>(hashOf(p, seed) >> 8) * 0x1p-24f;
}

/// Gradient noise (Perlin 2002), about -1 to 1, features of size 1.
inline float noise(vec3 p, std::uint32_t seed = 0) {
    const vec3 floor = glm::floor(p), f = p - floor;
    const ivec3 cell(floor);
    const vec3 u = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
    // Gradients are the edges of a cube.
    const auto corner = [&](int x, int y, int z) {
        const std::uint32_t h = hashOf(cell + ivec3(x, y, z), seed) & 15u;
        const vec3 d = f - vec3(x, y, z);
        const float a = h < 8 ? d.x : d.y, b = h < 4 ? d.y : (h & 13u) == 12 ? d.x : d.z;
        return ((h & 1u) ? -a : a) + ((h & 2u) ? -b : b);
    };
    const auto along = [&](int y, int z) {
        return glm::mix(corner(0, y, z), corner(1, y, z), u.x);
    };
    return glm::mix(glm::mix(along(0, 0), along(1, 0), u.y),
                    glm::mix(along(0, 1), along(1, 1), u.y), u.z);
}

/// Sum of octaves, each of half the size and half the strength; about -1 to 1.
inline float fractal(vec3 p, int octaves, std::uint32_t seed = 0) {
    float sum = 0, strength = 0.55f;
    for (int i = 0; i < octaves; ++i, strength *= 0.5f, p = p * 2.03f + 17.1f)
        sum += strength * noise(p, seed + static_cast<std::uint32_t>(i));
    return sum;
}

/// Octaves of |noise|: round bumps with sharp valleys, 0 in the valleys to about 1.
inline float billow(vec3 p, int octaves, std::uint32_t seed = 0) {
    float sum = 0, strength = 0.8f;
    for (int i = 0; i < octaves; ++i, strength *= 0.5f, p = p * 2.07f + 11.3f)
        sum += strength * std::abs(noise(p, seed + static_cast<std::uint32_t>(i)));
    return sum;
}

/// Thin sheets and filaments: 1 on the ridges, falling to 0 off them.
inline float ridges(vec3 p, int octaves, std::uint32_t seed = 0) {
    const float b = 1 - 1.6f * billow(p, octaves, seed);
    return b > 0 ? b * b : 0;
}

/// p moved along by noise of features of `size` by about `strength`.
inline vec3 warped(vec3 p, float size, float strength, int octaves, std::uint32_t seed) {
    const vec3 q = p / size;
    return p + strength * vec3(fractal(q, octaves, seed), fractal(q, octaves, seed + 50),
                               fractal(q, octaves, seed + 100));
}

/// Distance to the nearest of points strewn one to a cell of size 1, 0 to about 1: cauliflower.
inline float cells(vec3 p, std::uint32_t seed = 0) {
    const ivec3 cell(glm::floor(p));
    float nearest = 4;
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
                const ivec3 c = cell + ivec3(x, y, z);
                const vec3 d =
                    vec3(c) - p +
                    vec3(uniformOf(c, seed), uniformOf(c, seed + 1), uniformOf(c, seed + 2));
                nearest = std::min(nearest, glm::dot(d, d));
            }
    return std::sqrt(nearest);
}

/// 0 below `low`, 1 above `high`, smooth between.
inline float rise(float low, float high, float x) {
    const float t = glm::clamp((x - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

}  // namespace brume::gallery
