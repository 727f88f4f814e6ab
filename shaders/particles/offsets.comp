#version 460
// SPDX-License-Identifier: Apache-2.0
// Second pass of a tick: counts of chunks become offsets within their group.
#extension GL_GOOGLE_include_directive : require
#include "tick.glsl"

layout(set = 0, binding = kBindingChunks, scalar) buffer ChunksBlock { uint chunks[]; };
layout(set = 0, binding = kBindingGroups, scalar) writeonly buffer GroupsBlock { uint groups[]; };

void main() {
    Tick tick = ticks[push.slot];
    uint group = threadIndex();
    uint survivorGroups = groupOf(tick, tick.survivorChunks);
    uint chunkCount = tick.survivorChunks + tick.birthChunks;
    bool isBirth = group >= survivorGroups;
    uint begin = isBirth ? tick.survivorChunks + (group - survivorGroups) * kChunksPerGroup
                         : group * kChunksPerGroup;
    uint end = min(begin + kChunksPerGroup, isBirth ? chunkCount : tick.survivorChunks);
    if (begin >= end) return;

    uint sum = 0u;
    for (uint i = begin; i < end; ++i) {
        uint count = chunks[i];
        chunks[i] = sum;
        sum += count;
    }
    groups[group] = sum;
}
