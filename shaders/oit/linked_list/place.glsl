// SPDX-License-Identifier: Apache-2.0
// What the steps share that place a frame's lists in memory, on the device.
#ifndef BRUME_OIT_LINKED_LIST_PLACE_GLSL
#define BRUME_OIT_LINKED_LIST_PLACE_GLSL
#include "../../common/frame.h"
#include "../../gpu/address.glsl"
#include "../media_bins/bins.h"
#include "lists.h"

layout(push_constant, scalar) uniform Push { PlacePush push; };
layout(buffer_reference, scalar) buffer CounterBlock { ListCounters counters; };
layout(buffer_reference, scalar) buffer BandArray { ListBand at[]; };
layout(buffer_reference, scalar) buffer TileArray { ListTile at[]; };

uint divideUp(uint a, uint b) { return (a + b - 1u) / b; }
uint entryBlocks(uint entries) { return divideUp(entries, kBlockBytes / kEntryBytes); }
uint recordBlocks(uint records) {
    return uint((uint64_t(records) * push.recordBytes + (kBlockBytes - 1u)) / kBlockBytes);
}

// Of a row of a slot's tile, where lists have no entries.
uint rowBlocks(uint slot, uint row) {
    uint longest = 0u;
    for (uint column = 0u; column < kTileSize; ++column)
        longest = max(longest, UintArray(push.surfaceOffsets)
                                   .at[slot * kTileOffsets + row * kTileSize + column]);
    return longest * push.recordWords;
}

// A share of `x` as `part` is of `whole`, rounded down.
uint shareOf(uint x, uint part, uint whole) {
    return uint(uint64_t(x) * part / max(whole, 1u));
}

#endif
