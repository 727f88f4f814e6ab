// SPDX-License-Identifier: Apache-2.0
// Prefix sum, step 3: each chunk becomes its running sum.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "address.glsl"
#include "scan.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { ScanPush push; };

void main() {
    uint first = gl_GlobalInvocationID.x * kScanChunk;
    if (first >= push.count) return;
    uint last = min(first + kScanChunk, push.count);
    uint running = UintArray(push.sums).at[gl_GlobalInvocationID.x];
    for (uint i = first; i < last; ++i) {
        uint value = UintArray(push.values).at[i];
        UintArray(push.values).at[i] = running;
        running += value;
    }
}
