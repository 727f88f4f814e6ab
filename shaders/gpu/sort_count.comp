// SPDX-License-Identifier: Apache-2.0
// Radix sort, step 1: how often each digit occurs in each chunk.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "address.glsl"
#include "scan.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { SortPush push; };

void main() {
    uint chunk = gl_GlobalInvocationID.x;
    uint chunks = (push.count + kSortChunk - 1u) / kSortChunk;
    if (chunk >= chunks) return;
    UintArray counts = UintArray(push.counts);
    for (uint digit = 0u; digit < kSortDigits; ++digit) counts.at[digit * chunks + chunk] = 0u;
    uint last = min((chunk + 1u) * kSortChunk, push.count);
    for (uint i = chunk * kSortChunk; i < last; ++i) {
        uint digit = (UintArray(push.keysIn).at[i] >> push.shift) & (kSortDigits - 1u);
        counts.at[digit * chunks + chunk] += 1u;
    }
}
