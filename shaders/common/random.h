// SPDX-License-Identifier: Apache-2.0
// Counter-based random numbers: a pure function of a key and a counter, the same bits in C++ and
// GLSL. Source: Philox4x32-10, Salmon, Moraes, Dror, Shaw, "Parallel random numbers: as easy as 1,
// 2, 3", SC 2011, 10.1145/2063384.2063405. pcg3d: Jarzynski, Olano, "Hash functions for GPU
// rendering", JCGT 9(3), 2020.
#ifndef BRUME_SHADERS_COMMON_RANDOM_H
#define BRUME_SHADERS_COMMON_RANDOM_H

#include "shared_math.h"

BRUME_STRUCTS_BEGIN

/// Four independent random words for each counter under each key.
BRUME_SHARED uvec4 philox4x32(uvec4 counter, uvec2 key) {
    for (int roundIndex = 0; roundIndex < 10; ++roundIndex) {
        uint high0, low0, high1, low1;
        umulExtended(0xD2511F53u, counter.x, high0, low0);
        umulExtended(0xCD9E8D57u, counter.z, high1, low1);
        counter = uvec4(high1 ^ counter.y ^ key.x, low1, high0 ^ counter.w ^ key.y, low0);
        key = uvec2(key.x + 0x9E3779B9u, key.y + 0xBB67AE85u);
    }
    return counter;
}

/// A fast hash of three words to three words, for lattice noise.
BRUME_SHARED uvec3 pcg3d(uvec3 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v = uvec3(v.x ^ (v.x >> 16u), v.y ^ (v.y >> 16u), v.z ^ (v.z >> 16u));
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

/// Uniform in [0, 1): the 24 high bits of a word, exactly.
BRUME_SHARED float unitFloat(uint word) {
    BRUME_PRECISE float u = float(word >> 8u) * 5.9604644775390625e-8f;
    return u;
}

/// Uniform in [-1, 1), exactly.
BRUME_SHARED float signedUnitFloat(uint word) {
    BRUME_PRECISE float u = float(word >> 8u) * 1.1920928955078125e-7f - 1.0f;
    return u;
}

/// Who draws: every stream of the same seed and instance differs by what is counted (birth index)
/// and what for (channel).
struct RandomStream {
    uint seedLow;
    uint seedHigh;
    uint instance;
};

/// The four words of one channel of one counted thing.
BRUME_SHARED uvec4 randomWords(RandomStream stream, uint index, uint channel) {
    return philox4x32(uvec4(index, channel, stream.instance, 0u),
                      uvec2(stream.seedLow, stream.seedHigh));
}

BRUME_STRUCTS_END
#endif
