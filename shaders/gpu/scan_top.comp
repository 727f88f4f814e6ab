// SPDX-License-Identifier: Apache-2.0
// Prefix sum, step 2: one invocation sums the chunks' sums; the total goes behind the last.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "address.glsl"
#include "scan.h"

layout(local_size_x = 1) in;
layout(push_constant, scalar) uniform Push { ScanPush push; };

void main() {
    UintArray sums = UintArray(push.sums);
    uint chunks = (push.count + kScanChunk - 1u) / kScanChunk;
    uint running = 0u;
    for (uint i = 0u; i < chunks; ++i) {
        uint sum = sums.at[i];
        sums.at[i] = running;
        running += sum;
    }
    sums.at[chunks] = running;
}
