// SPDX-License-Identifier: Apache-2.0
// Radix sort, step 1: how often each digit occurs in each chunk.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "address.glsl"
#include "sort.glsl"

uint found[kSortDigits];

void count(uint i) { found[digitOf(loadKey(i))] += 1u; }

void main() {
    uint chunk = gl_GlobalInvocationID.x;
    uint chunks = chunkCount();
    if (chunk >= chunks) return;
    for (uint digit = 0u; digit < kSortDigits; ++digit) found[digit] = 0u;
    uvec2 range = chunkRange(chunk);
    uint i = range.x;
    for (; i + kSortUnrolled <= range.y; i += kSortUnrolled)
        for (uint k = 0u; k < kSortUnrolled; ++k) count(i + k);
    for (; i < range.y; ++i) count(i);
    for (uint digit = 0u; digit < kSortDigits; ++digit)
        counts[digit * chunks + chunk] = found[digit];
}
