// SPDX-License-Identifier: Apache-2.0
// Curl noise: a smooth random acceleration field without sources or sinks.
// Source: Bridson, Hourihan, Nordenstam, "Curl-noise for procedural fluid flow", ACM TOG 26(3),
// 2007, 10.1145/1276377.1276435; lattice and kernel of simplex noise: Perlin, "Noise hardware",
// SIGGRAPH 2001 course notes. Equations: potential psi(x) = sum over lattice corners c of t^4 (q_c
// x d), d = x - c, t = max(0, 1/2 - |d|^2), q_c a random vector; its curl is sum 2 t^4 q_c - 8 t^3
// (|d|^2 q_c - (d . q_c) d), exactly divergence-free. Differs: the potential is a cross product
// with a random vector instead of three scalar noises: one kernel evaluation per corner, and no
// derivative is approximated. Limits: repeats after 2^20 cells.
#ifndef BRUME_SHADERS_PARTICLES_MODULES_CURL_NOISE_H
#define BRUME_SHADERS_PARTICLES_MODULES_CURL_NOISE_H

#include "../../common/random.h"
#include "../../common/replayable_math.h"

BRUME_STRUCTS_BEGIN

struct CurlNoise {
    float strength;   // of the first octave: acceleration for a field of unit root mean square
    float frequency;  // cells per metre of the first octave; doubles with each
    uint octaves;
    uint seed;  // with the seed of the instance
};

/// How far a drifting noise has come: whole lattice vectors, which integers count for ever without
/// loss, and the rest. The lattice vector of cells (a, b, c) is (a, b, c) - (a + b + c) / 6.
struct CurlNoiseShift {
    uvec3 cells;
    vec3 rest;  // in units of the kernel
};

/// What one lattice corner adds: `cell` its integer coordinates, `d` the way from it in cells.
BRUME_SHARED vec3 curlNoiseCorner(vec3 cell, vec3 d, uvec3 shift, uint seed) {
    // Coordinates modulo 2^20, because the conversion of larger floats to integers is not defined.
    BRUME_PRECISE vec3 wrapped =
        cell - vec3(floor(cell.x * 9.5367431640625e-7f), floor(cell.y * 9.5367431640625e-7f),
                    floor(cell.z * 9.5367431640625e-7f)) *
                   1048576.0f;
    // The sums likewise, so that a corner has one number from wherever it is counted.
    uvec3 corner = uvec3((uint(wrapped.x) + shift.x) & 0xfffffu, (uint(wrapped.y) + shift.y) & 0xfffffu,
                         (uint(wrapped.z) + shift.z) & 0xfffffu);
    uvec3 hash = pcg3d(uvec3(corner.x + seed, corner.y + (seed ^ 0x9e3779b9u),
                             corner.z + seed * 0x85ebca6bu));
    BRUME_PRECISE vec3 q =
        vec3(signedUnitFloat(hash.x), signedUnitFloat(hash.y), signedUnitFloat(hash.z));
    BRUME_PRECISE float d2 = dotReplayable(d, d);
    BRUME_PRECISE float t = 0.5f - d2;
    t = t > 0.0f ? t : 0.0f;
    BRUME_PRECISE float t3 = t * t * t;
    BRUME_PRECISE vec3 curl =
        q * (2.0f * t3 * t - 8.0f * t3 * d2) + d * (8.0f * t3 * dotReplayable(d, q));
    return curl;
}

/// One octave at lattice position p, in units of the kernel.
BRUME_SHARED vec3 curlNoiseOctave(vec3 p, uvec3 shift, uint seed) {
    // Skew to the cubic lattice to find the cell, and back.
    BRUME_PRECISE float skew = (p.x + p.y + p.z) * 0.33333333f;
    BRUME_PRECISE vec3 cell = vec3(floor(p.x + skew), floor(p.y + skew), floor(p.z + skew));
    BRUME_PRECISE float unskew = (cell.x + cell.y + cell.z) * 0.16666667f;
    BRUME_PRECISE vec3 d =
        vec3(p.x - (cell.x - unskew), p.y - (cell.y - unskew), p.z - (cell.z - unskew));

    // The simplex: the largest coordinate steps first.
    bool xy = d.x >= d.y;
    bool xz = d.x >= d.z;
    bool yz = d.y >= d.z;
    vec3 step1 = vec3(xy && xz ? 1.0f : 0.0f, !xy && yz ? 1.0f : 0.0f, !xz && !yz ? 1.0f : 0.0f);
    vec3 step2 = vec3(xy || xz ? 1.0f : 0.0f, !xy || yz ? 1.0f : 0.0f, !(xz && yz) ? 1.0f : 0.0f);

    BRUME_PRECISE vec3 sum = curlNoiseCorner(cell, d, shift, seed);
    BRUME_PRECISE vec3 cell1 = cell + step1;
    BRUME_PRECISE vec3 d1 = d - step1 + 0.16666667f;
    sum = sum + curlNoiseCorner(cell1, d1, shift, seed);
    BRUME_PRECISE vec3 cell2 = cell + step2;
    BRUME_PRECISE vec3 d2 = d - step2 + 0.33333333f;
    sum = sum + curlNoiseCorner(cell2, d2, shift, seed);
    BRUME_PRECISE vec3 cell3 = cell + 1.0f;
    BRUME_PRECISE vec3 d3 = d - 0.5f;
    sum = sum + curlNoiseCorner(cell3, d3, shift, seed);
    return sum;
}

/// Acceleration in m/s^2 at `position` in metres. Octave o has 2^o times the frequency and 2^-o
/// times the strength.
BRUME_SHARED vec3 curlNoiseAcceleration(CurlNoise noise, CurlNoiseShift drift, uint seed,
                                        vec3 position) {
    BRUME_PRECISE vec3 p = position * noise.frequency + drift.rest;
    uvec3 shift = drift.cells;
    BRUME_PRECISE float amplitude = noise.strength;
    BRUME_PRECISE vec3 sum = vec3(0.0f);
    for (uint octave = 0u; octave < noise.octaves; ++octave) {
        sum = sum + curlNoiseOctave(p, shift, noise.seed + seed + octave) * amplitude;
        // The offset keeps the octaves' lattices from meeting at the origin; its value is chosen by
        // us.
        p = p * 2.0f + vec3(0.37f, 0.71f, 0.13f);
        shift = shift * 2u;
        amplitude = amplitude * 0.5f;
    }
    return sum;
}

BRUME_STRUCTS_END
#endif
