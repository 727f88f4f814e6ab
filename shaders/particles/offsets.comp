#version 460
// SPDX-License-Identifier: Apache-2.0
// Second pass of a tick: counts of chunks become offsets within their group.
#extension GL_GOOGLE_include_directive : require
#include "tick.glsl"

layout(set = 0, binding = kBindingChunks, scalar) buffer ChunksBlock { uint chunks[]; };
layout(set = 0, binding = kBindingGroups, scalar) writeonly buffer GroupsBlock { uint groups[]; };

void main() {
    Tick tick = ticks[push.slot];
    uint thread = threadIndex();
    if (thread >= tick.groups * tick.instances) return;
    uint instance = thread / tick.groups;
    uint group = thread - instance * tick.groups;
    uint survivorGroups = groupOf(tick, tick.survivorChunks);
    bool isBirth = group >= survivorGroups;
    uint begin = isBirth ? tick.survivorChunks + (group - survivorGroups) * kChunksPerGroup
                         : group * kChunksPerGroup;
    uint end = min(begin + kChunksPerGroup, isBirth ? tick.chunks : tick.survivorChunks);

    uint sum = 0u;
    uint base = instance * tick.chunks;
    for (uint i = base + begin; i < base + end; ++i) {
        uint count = chunks[i];
        chunks[i] = sum;
        sum += count;
    }
    groups[thread] = sum;
}
