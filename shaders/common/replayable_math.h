// SPDX-License-Identifier: Apache-2.0
// Functions with the same bits on every device and on the CPU, built from + - * and integers only:
// square root, quotient, direction and frame of vectors, sine and cosine of turns, and the three
// factors of the exponential integrator.
#ifndef BRUME_SHADERS_COMMON_REPLAYABLE_MATH_H
#define BRUME_SHADERS_COMMON_REPLAYABLE_MATH_H

#include "shared_math.h"

BRUME_STRUCTS_BEGIN

BRUME_SHARED float dotReplayable(vec3 a, vec3 b) {
    BRUME_PRECISE float sum = a.x * b.x + a.y * b.y + a.z * b.z;
    return sum;
}

/// Square root of x >= 0 to 1 ulp; 0 below 1e-30. Newton on the reciprocal root, then one corrected
/// step.
BRUME_SHARED float sqrtReplayable(float x) {
    BRUME_PRECISE float halfX = 0.5f * x;
    BRUME_PRECISE float r = uintBitsToFloat(0x5f3759dfu - (floatBitsToUint(x) >> 1u));
    for (int i = 0; i < 3; ++i) r = r * (1.5f - halfX * r * r);
    BRUME_PRECISE float root = x * r;
    root = root + 0.5f * r * (x - root * root);
    return x < 1e-30f ? 0.0f : root;
}

/// 1 / x to 1 ulp, for 1e-30 <= |x| <= 1e30; finite or infinite, never NaN, at 0. Newton.
BRUME_SHARED float reciprocalReplayable(float x) {
    uint bits = floatBitsToUint(x);
    BRUME_PRECISE float r =
        uintBitsToFloat((bits & 0x80000000u) | (0x7ef311c3u - (bits & 0x7fffffffu)));
    for (int i = 0; i < 4; ++i) r = r * (2.0f - x * r);
    return r;
}

BRUME_SHARED float lengthReplayable(vec3 v) { return sqrtReplayable(dotReplayable(v, v)); }

/// v as a unit vector; `fallback` if |v| is below 1e-15.
BRUME_SHARED vec3 directionReplayable(vec3 v, vec3 fallback) {
    BRUME_PRECISE float size = lengthReplayable(v);
    BRUME_PRECISE vec3 direction = v * reciprocalReplayable(size > 0.0f ? size : 1.0f);
    return size > 0.0f ? direction : fallback;
}

BRUME_SHARED vec3 crossReplayable(vec3 a, vec3 b) {
    BRUME_PRECISE vec3 product =
        vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
    return product;
}

/// Two unit vectors orthogonal to the unit vector `axis` and to each other.
/// Source: Duff et al., "Building an orthonormal basis, revisited", JCGT 6(1), 2017.
BRUME_SHARED void frameReplayable(vec3 axis, BRUME_OUT(vec3) tangent, BRUME_OUT(vec3) bitangent) {
    BRUME_PRECISE float sign = axis.z >= 0.0f ? 1.0f : -1.0f;
    BRUME_PRECISE float a = reciprocalReplayable(0.0f - (sign + axis.z));
    BRUME_PRECISE float b = axis.x * axis.y * a;
    BRUME_PRECISE vec3 t = vec3(1.0f + sign * axis.x * axis.x * a, sign * b, sign * -axis.x);
    BRUME_PRECISE vec3 u = vec3(b, sign + axis.y * axis.y * a, -axis.y);
    tangent = t;
    bitangent = u;
}

/// cos and sin of 2 pi turns, turns in [0, 1], to 2e-7. Taylor to degree 8 and 9 over an eighth of
/// a turn.
BRUME_SHARED void cosSinTurns(float turns, BRUME_OUT(float) cosine, BRUME_OUT(float) sine) {
    BRUME_PRECISE float quadrant = floor(turns * 4.0f + 0.5f);
    BRUME_PRECISE float a = (turns - quadrant * 0.25f) * 6.283185307179586f;
    BRUME_PRECISE float a2 = a * a;
    BRUME_PRECISE float c =
        1.0f - a2 * (0.5f - a2 * (0.041666666667f - a2 * (0.0013888888889f - a2 * 2.4801587e-5f)));
    BRUME_PRECISE float s =
        a * (1.0f - a2 * (0.16666666667f -
                          a2 * (0.0083333333333f - a2 * (0.00019841269841f - a2 * 2.7557319e-6f))));
    uint q = uint(quadrant) & 3u;
    cosine = q == 0u ? c : q == 1u ? -s : q == 2u ? -c : s;
    sine = q == 0u ? s : q == 1u ? c : q == 2u ? -s : -c;
}

/// loss = 1 - exp(-y), phi1 = loss / y, phi2 = (1 - phi1) / y, for 0 <= y <= 2^halvings.
/// Taylor of phi2 on [0, 1], then the doubling formulas of exponential integrators, e.g. Higham,
/// "Functions of matrices", SIAM 2008, section 10.7.4.
BRUME_SHARED void exponentialFactors(float y, uint halvings, BRUME_OUT(float) loss,
                                     BRUME_OUT(float) phi1, BRUME_OUT(float) phi2) {
    BRUME_PRECISE float z = y * uintBitsToFloat((127u - halvings) << 23u);
    BRUME_PRECISE float p2 = 2.4801587302e-5f - z * (2.7557319224e-6f - z * 2.7557319e-7f);
    p2 = 0.0083333333333f - z * (0.0013888888889f - z * (0.00019841269841f - z * p2));
    p2 = 0.5f - z * (0.16666666667f - z * (0.041666666667f - z * p2));
    BRUME_PRECISE float p1 = 1.0f - z * p2;
    BRUME_PRECISE float l = z * p1;
    for (uint i = 0u; i < halvings; ++i) {
        p2 = 0.25f * (p1 * p1 + 2.0f * p2);
        p1 = p1 * (1.0f - 0.5f * l);
        l = l * (2.0f - l);
    }
    loss = l;
    phi1 = p1;
    phi2 = p2;
}

BRUME_STRUCTS_END
#endif
