// SPDX-License-Identifier: Apache-2.0
// Vector types and small functions used on the CPU in double precision.
#pragma once

#define GLM_FORCE_SILENT_WARNINGS
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace brume {

using glm::dmat3;
using glm::dmat4;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;
using glm::ivec2;
using glm::ivec3;
using glm::mat4;
using glm::uvec2;
using glm::vec2;
using glm::vec3;
using glm::vec4;

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline constexpr double radians(double degrees) { return degrees * (kPi / 180.0); }

/// What the float nearest to `value` has lost of it.
inline float roundingOf(double value) {
    // GCC 12 folds the conversion to float and back for two values next to each other, as if it
    // lost nothing, unless the float must be seen.
    const volatile float nearest = static_cast<float>(value);
    return static_cast<float>(value - static_cast<double>(nearest));
}
inline vec3 roundingOf(const dvec3& value) {
    return {roundingOf(value.x), roundingOf(value.y), roundingOf(value.z)};
}
inline glm::mat4x3 roundingOf(const glm::dmat4x3& value) {
    return {roundingOf(value[0]), roundingOf(value[1]), roundingOf(value[2]),
            roundingOf(value[3])};
}

/// Axis-aligned box; empty (lo > hi) by default.
struct Box3 {
    dvec3 lo{kInfinity};
    dvec3 hi{-kInfinity};

    bool isEmpty() const { return lo.x > hi.x || lo.y > hi.y || lo.z > hi.z; }
    void extend(const dvec3& p) { lo = glm::min(lo, p), hi = glm::max(hi, p); }
    void extend(const Box3& b) { lo = glm::min(lo, b.lo), hi = glm::max(hi, b.hi); }
    dvec3 center() const { return 0.5 * (lo + hi); }
    dvec3 size() const { return hi - lo; }
};

/// The box around `b` after the affine map `m`.
inline Box3 transformBox(const dmat4& m, const Box3& b) {
    Box3 r;
    if (b.isEmpty()) return r;
    for (int corner = 0; corner < 8; ++corner)
        r.extend(dvec3(m * dvec4(corner & 1 ? b.hi.x : b.lo.x, corner & 2 ? b.hi.y : b.lo.y,
                                 corner & 4 ? b.hi.z : b.lo.z, 1.0)));
    return r;
}

inline dvec3 transformPoint(const dmat4& m, const dvec3& p) { return dvec3(m * dvec4(p, 1.0)); }
inline dvec3 transformVector(const dmat4& m, const dvec3& v) { return dvec3(m * dvec4(v, 0.0)); }

}  // namespace brume
