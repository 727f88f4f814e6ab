// SPDX-License-Identifier: Apache-2.0
// Gives the lists of each tile their place in the memory of one of the bands. Where all bands are
// too small together, each tile keeps the same share of what it wants, and in it each pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "place.glsl"

layout(local_size_x = 64) in;

// How the frame shares the memory: tiles begin in the first `reach` blocks of a band, so that they
// end within it; all together want `wanted` blocks and get `granted`.
struct Sharing {
    uint reach;
    uint wanted;
    uint granted;
};

Sharing findSharing(ListCounters counted) {
    uint wanted = UintArray(push.blocks).at[push.slotCapacity];
    if (wanted <= push.blockCapacity) return Sharing(push.blockCapacity, wanted, wanted);
    if (counted.largestTile < push.blockCapacity) {
        uint reach = push.blockCapacity - counted.largestTile;
        if ((wanted - 1u) / reach < push.bandCount) return Sharing(reach, wanted, wanted);
    }
    if (push.bandCount == 1u) return Sharing(push.blockCapacity, wanted, push.blockCapacity);
    // No tile may get more than half of a band.
    uint reach = push.blockCapacity / 2u;
    uint64_t most = min(uint64_t(push.bandCount) * reach,
                        uint64_t(wanted) * (max(reach, 1u) - 1u) / max(counted.largestTile, 1u));
    return Sharing(max(reach, 1u), wanted, uint(min(most, uint64_t(wanted))));
}

void addTo(bool isDropped, uint count) {
    uint old = isDropped ? atomicAdd(CounterBlock(push.counters).counters.dropped.x, count)
                         : atomicAdd(CounterBlock(push.counters).counters.stored.x, count);
    if (old + count >= old) return;
    if (isDropped)
        atomicAdd(CounterBlock(push.counters).counters.dropped.y, 1u);
    else
        atomicAdd(CounterBlock(push.counters).counters.stored.y, 1u);
}

// Where the surfaces of a pixel begin.
void placeSurfaces(uint slot, uint pixel, uint offset) {
    UintArray(push.surfaceOffsets).at[slot * kTileOffsets + pixel] = offset;
    if (pixel < 64u) UintArray(push.surfaceCursors).at[slot * 64u + pixel] = offset;
}

// Counts become offsets into the tile's room for `mediaRoom` media and `surfaceRoom` surfaces.
void placePixels(uint slot, uint media, uint surfaces, uint mediaRoom, uint surfaceRoom) {
    uint mediaBefore = 0u, surfacesBefore = 0u;
    for (uint pixel = 0u; pixel < kTileOffsets; ++pixel) {  // the last count is 0
        uint at = slot * kTileOffsets + pixel;
        uint count = UintArray(push.offsets).at[at];
        UintArray(push.offsets).at[at] = mediaBefore + surfacesBefore;
        mediaBefore += count;
        if (push.drawCount == 0u) continue;
        count = UintArray(push.surfaceOffsets).at[at];
        placeSurfaces(slot, pixel, surfacesBefore);
        surfacesBefore += count;
    }
    // A loop, because some devices step through what an `if` leaves out; divisions of 64 bits are
    // dear there.
    bool hasRoom = mediaRoom == media && surfaceRoom == surfaces;
    for (uint pixel = hasRoom ? kTileOffsets : 0u; pixel < kTileOffsets; ++pixel) {
        uint at = slot * kTileOffsets + pixel;
        uint before = push.drawCount > 0u ? UintArray(push.surfaceOffsets).at[at] : 0u;
        uint offset = shareOf(UintArray(push.offsets).at[at] - before, mediaRoom, media);
        uint surfaceOffset = shareOf(before, surfaceRoom, surfaces);
        UintArray(push.offsets).at[at] = offset + surfaceOffset;
        if (push.drawCount > 0u) placeSurfaces(slot, pixel, surfaceOffset);
    }
}

// Where lists have no entries. They always have room: a frame like this one has been measured.
void placeRows(uint slot, uint firstBlock) {
    for (uint row = 0u; row < kTileSize; ++row) {
        uint blocks = rowBlocks(slot, row);
        for (uint column = 0u; column < kTileSize; ++column)
            placeSurfaces(slot, row * kTileSize + column, firstBlock * kTileSize + column);
        firstBlock += blocks;
    }
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    ListCounters counted = CounterBlock(push.counters).counters;
    if (slot >= counted.slots) return;
    Sharing sharing = findSharing(counted);
    uint first = shareOf(UintArray(push.blocks).at[slot], sharing.granted, sharing.wanted);
    uint end = shareOf(UintArray(push.blocks).at[slot + 1u], sharing.granted, sharing.wanted);
    uint room = end - first;

    uint media = 0u, surfaces = 0u;
    for (uint i = slot * kTileOffsets; i < slot * kTileOffsets + 64u; ++i) {
        media += UintArray(push.offsets).at[i];
        if (push.drawCount > 0u) surfaces += UintArray(push.surfaceOffsets).at[i];
    }
    uint entryRoom = media + surfaces, surfaceRoom = surfaces;
    uint forRecords = 0u;
    if (push.recordWords == 0u) {
        forRecords = recordBlocks(surfaces);
        forRecords = shareOf(forRecords, room, entryBlocks(entryRoom) + forRecords);
        entryRoom = min((room - forRecords) * (kBlockBytes / kEntryBytes), entryRoom);
        surfaceRoom = min(min(forRecords * kBlockBytes / push.recordBytes, entryRoom), surfaces);
    }
    uint mediaRoom = min(entryRoom - surfaceRoom, media);

    // Empty tiles at the very end begin where nothing is.
    uint band = min(first / sharing.reach, push.bandCount - 1u);
    first -= band * sharing.reach;
    TileArray(push.tiles).at[slot] = ListTile(first, first + (room - forRecords));
    if (push.recordWords > 0u)
        placeRows(slot, first);
    else
        placePixels(slot, media, surfaces, mediaRoom, surfaceRoom);
    atomicMin(BandArray(push.bands).at[1u + band].firstSlot, slot);
    atomicAdd(BandArray(push.bands).at[1u + band].slotCount, 1u);
    addTo(false, mediaRoom + surfaceRoom);
    addTo(true, media - mediaRoom + surfaces - surfaceRoom);
    uint old = atomicAdd(CounterBlock(push.counters).counters.surfaces.x, surfaceRoom);
    if (old + surfaceRoom < old) atomicAdd(CounterBlock(push.counters).counters.surfaces.y, 1u);
    atomicMax(CounterBlock(push.counters).counters.bands, band + 1u);
    if (slot == 0u) CounterBlock(push.counters).counters.blocks = sharing.wanted;
}
