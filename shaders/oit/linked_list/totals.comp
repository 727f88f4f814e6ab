// SPDX-License-Identifier: Apache-2.0
// How many blocks of memory the lists of each tile want.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "place.glsl"

layout(local_size_x = 64) in;

void main() {
    uint slot = gl_GlobalInvocationID.x;
    ListCounters counted = CounterBlock(push.counters).counters;
    if (slot >= counted.slots) return;
    uint entries = 0u, surfaces = 0u, longest = 0u;
    for (uint i = slot * kTileOffsets; i < slot * kTileOffsets + 64u; ++i) {
        uint count = UintArray(push.offsets).at[i];
        if (push.drawCount > 0u) {
            uint faces = UintArray(push.surfaceOffsets).at[i];
            surfaces += faces;
            count += faces;
        }
        entries += count;
        longest = max(longest, count);
    }
    uint blocks = entryBlocks(entries) + recordBlocks(surfaces);
    if (push.recordWords > 0u) {
        blocks = 0u;
        for (uint row = 0u; row < kTileSize; ++row) blocks += rowBlocks(slot, row);
    }
    UintArray(push.blocks).at[slot] = blocks;
    atomicMax(CounterBlock(push.counters).counters.largestTile, blocks);
    atomicMax(CounterBlock(push.counters).counters.longest, longest);
}
