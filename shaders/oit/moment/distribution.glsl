// SPDX-License-Identifier: Apache-2.0
// From moments to the share of the optical depth in front of a place: the canonical representation
// of the moments with a node there (Hamburger's problem).
#ifndef BRUME_OIT_MOMENT_DISTRIBUTION_GLSL
#define BRUME_OIT_MOMENT_DISTRIBUTION_GLSL
#include "place.glsl"

layout(constant_id = kMomentBias) const float kBias = 6e-5;

const uint kDegree = kMoments / 2u;  // of the polynomial whose roots are the other nodes
const uint kMost = 4u;               // the largest degree
const uint kSize = kMost + 1u;

// H = L D L^T, the Hankel matrix of the moments.
struct Decomposition {
    float l[kSize * kSize];
    float d[kSize];
};

Decomposition decompose(float moments[2u * kMost + 1u]) {
    Decomposition h;
    for (uint i = 0u; i < kSize; ++i) h.d[i] = 1.0;
    for (uint i = 0u; i < kSize * kSize; ++i) h.l[i] = 0.0;
    for (uint i = 0u; i <= kDegree; ++i)
        for (uint j = 0u; j <= i; ++j) {
            float sum = moments[i + j];
            for (uint k = 0u; k < j; ++k) sum -= h.l[i * kSize + k] * h.l[j * kSize + k] * h.d[k];
            if (i == j)
                h.d[i] = max(sum, 1e-9);
            else
                h.l[i * kSize + j] = sum / h.d[j];
        }
    return h;
}

// L^-1 (1, x, x^2, ...)
void solvePowers(Decomposition h, float x, out float y[kSize]) {
    float power = 1.0;
    for (uint i = 0u; i < kSize; ++i) y[i] = 0.0;
    for (uint i = 0u; i <= kDegree; ++i) {
        y[i] = power;
        for (uint k = 0u; k < i; ++k) y[i] -= h.l[i * kSize + k] * y[k];
        power *= x;
    }
}

// The polynomial v(z)^T H^-1 v(x) in x: its roots are the other nodes of the representation.
void findPolynomial(Decomposition h, float z, out float p[kSize]) {
    solvePowers(h, z, p);
    for (uint i = 0u; i <= kDegree; ++i) p[i] /= h.d[i];
    for (int i = int(kDegree); i >= 0; --i)
        for (uint k = uint(i) + 1u; k <= kDegree; ++k) p[i] -= h.l[k * kSize + uint(i)] * p[k];
}

// The weight of a node: 1 / (v(x)^T H^-1 v(x)), positive whatever has been rounded.
float weightOf(Decomposition h, float x) {
    float y[kSize];
    solvePowers(h, x, y);
    float sum = 0.0;
    for (uint i = 0u; i <= kDegree; ++i) sum += y[i] * y[i] / h.d[i];
    return 1.0 / max(sum, 1e-30);
}

float evaluate(float p[kSize], float x) {
    float value = p[kMost];
    for (int i = int(kMost) - 1; i >= 0; --i) value = value * x + p[i];
    return value;
}

// The root of p in [lo, hi] by bisection and a last secant; where there is none, the end that is
// nearer to one.
float findRoot(float p[kSize], float lo, float hi) {
    float atLo = evaluate(p, lo), atHi = evaluate(p, hi);
    if ((atLo < 0.0) == (atHi < 0.0)) return abs(atLo) < abs(atHi) ? lo : hi;
    for (int i = 0; i < 14; ++i) {
        float x = 0.5 * (lo + hi), at = evaluate(p, x);
        bool isLow = (at < 0.0) == (atLo < 0.0);
        lo = isLow ? x : lo;
        atLo = isLow ? at : atLo;
        hi = isLow ? hi : x;
        atHi = isLow ? atHi : at;
    }
    return clamp(lo - atLo * (hi - lo) / (atHi - atLo), lo, hi);
}

// All roots, which are real: those of each derivative lie between those of the next.
void findRoots(float p[kSize], out float roots[kMost]) {
    const float kBound = 8.0;  // a node beyond it weighs next to nothing
    for (uint i = 0u; i < kMost; ++i) roots[i] = kBound;
    float derivative[kSize];
    for (uint degree = 1u; degree <= kDegree; ++degree) {
        uint order = kDegree - degree;
        for (uint i = 0u; i < kSize; ++i) {
            float factor = 1.0;
            for (uint k = 0u; k < order; ++k) factor *= float(i + order - k);
            derivative[i] = i <= degree ? p[min(i + order, kMost)] * factor : 0.0;
        }
        float next[kMost];
        for (uint i = 0u; i < degree; ++i)
            next[i] = findRoot(derivative, i == 0u ? -kBound : roots[i - 1u],
                               i + 1u < degree ? roots[i] : kBound);
        for (uint i = 0u; i < degree; ++i) roots[i] = next[i];
    }
}

// `low`, `high`: moments 1 to 8 divided by the depth. A layer alone at its place has nothing in
// front of it.
float shareBefore(vec4 low, vec4 high, float z) {
    // Everything at one place: the Hankel matrix has rank one.
    float variance = low.y - low.x * low.x, smallest = max(4.0 * kBias, 1e-6);
    if (variance < smallest)
        return clamp((z - low.x) / (4.0 * sqrt(smallest)), 0.0, 1.0);
    // Towards the moments of the arcsine distribution, which are far from all borders.
    low = mix(low, vec4(0.0, 0.5, 0.0, 0.375), kBias);
    high = mix(high, vec4(0.0, 0.3125, 0.0, 0.2734375), kBias);
    float moments[2u * kMost + 1u] =
        float[](1.0, low.x, low.y, low.z, low.w, high.x, high.y, high.z, high.w);
    Decomposition h = decompose(moments);
    float p[kSize], roots[kMost];
    findPolynomial(h, z, p);
    findRoots(p, roots);
    float share = 0.0;
    for (uint i = 0u; i < kDegree; ++i) share += roots[i] < z ? weightOf(h, roots[i]) : 0.0;
    return share <= 1.0 ? share : 1.0;
}

#endif
