// SPDX-License-Identifier: Apache-2.0
// Radix sort, step 3 (after a prefix sum over the counts): stable scatter by digit.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "address.glsl"
#include "sort.glsl"

uint targets[kSortDigits];

void move(uint i) {
    uint64_t pair = loadPair(i);
    uint digit = digitOf(uint(pair));
    uint target = targets[digit];
    targets[digit] = target + 1u;
    storePair(target, pair);
}

void main() {
    uint chunk = gl_GlobalInvocationID.x;
    uint chunks = chunkCount();
    if (chunk >= chunks) return;
    for (uint digit = 0u; digit < kSortDigits; ++digit)
        targets[digit] = counts[digit * chunks + chunk];
    uvec2 range = chunkRange(chunk);
    uint i = range.x;
    for (; i + kSortUnrolled <= range.y; i += kSortUnrolled)
        for (uint k = 0u; k < kSortUnrolled; ++k) move(i + k);
    for (; i < range.y; ++i) move(i);
}
