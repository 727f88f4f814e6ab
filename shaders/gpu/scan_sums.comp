// SPDX-License-Identifier: Apache-2.0
// Prefix sum, step 1: the sum of each chunk.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "address.glsl"
#include "scan.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { ScanPush push; };

void main() {
    uint first = gl_GlobalInvocationID.x * kScanChunk;
    uint last = min(first + kScanChunk, push.count);
    uint sum = 0u;
    for (uint i = first; i < last; ++i) sum += UintArray(push.values).at[i];
    if (first < push.count) UintArray(push.sums).at[gl_GlobalInvocationID.x] = sum;
}
