// SPDX-License-Identifier: Apache-2.0
// Radix sort, step 3 (after a prefix sum over the counts): stable scatter by digit.
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
    uint last = min((chunk + 1u) * kSortChunk, push.count);
    for (uint i = chunk * kSortChunk; i < last; ++i) {
        uint key = UintArray(push.keysIn).at[i];
        uint value = UintArray(push.valuesIn).at[i];
        uint slot = ((key >> push.shift) & (kSortDigits - 1u)) * chunks + chunk;
        uint target = counts.at[slot];
        counts.at[slot] = target + 1u;
        UintArray(push.keysOut).at[target] = key;
        UintArray(push.valuesOut).at[target] = value;
    }
}
