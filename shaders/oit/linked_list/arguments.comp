// SPDX-License-Identifier: Apache-2.0
// One invocation: turns numbers of tiles into arguments of indirect dispatches and draws. First of
// all for all tiles, from the number of them that have lists; then for the bands.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "place.glsl"

layout(local_size_x = 1) in;
layout(constant_id = 0) const bool kBands = false;
layout(buffer_reference, scalar) buffer DrawArray { DrawArguments at[]; };
layout(buffer_reference, scalar) readonly buffer BinTotalsArray { BinTotals at[]; };

// Devices allow at least 65 535 workgroups to each side.
uvec3 groupsOf(uint count) {
    uint rows = divideUp(count, 65535u);
    return uvec3(divideUp(count, max(rows, 1u)), rows, 1u);
}

ListBand makeBand(uint firstSlot, uint slotCount, uint longestBin) {
    ListBand band;
    band.columns = groupsOf(divideUp(slotCount * kTileSize, 64u));
    band.laterColumns = longestBin > kMediaPerSlice ? band.columns : uvec3(0u, 1u, 1u);
    band.pixels = groupsOf(slotCount);
    band.slots = groupsOf(divideUp(slotCount, 64u));
    band.firstSlot = slotCount > 0u ? firstSlot : 0u;
    band.slotCount = slotCount;
    return band;
}

void main() {
    BinTotalsArray bins = BinTotalsArray(push.binTotals);
    uint longestBin = max(bins.at[0].longest, bins.at[1].longest);
    if (!kBands) {
        uint slots = min(UintArray(push.tileMap).at[0], push.slotCapacity);
        CounterBlock(push.counters).counters.slots = slots;
        BandArray(push.bands).at[0] = makeBand(0u, slots, longestBin);
        for (uint i = 1u; i <= push.bandCount; ++i) {
            BandArray(push.bands).at[i].firstSlot = ~0u;
            BandArray(push.bands).at[i].slotCount = 0u;
        }
        return;
    }
    for (uint i = 1u; i <= push.bandCount; ++i) {
        ListBand band = BandArray(push.bands).at[i];
        BandArray(push.bands).at[i] = makeBand(band.firstSlot, band.slotCount, longestBin);
        for (uint d = 0u; d < push.drawCount; ++d)
            DrawArray(push.draws).at[(i - 1u) * push.drawCount + d].instances =
                min(band.slotCount, 1u);
    }
}
