// SPDX-License-Identifier: Apache-2.0
// The order of pixels in the lists, and the arrays behind the push constants.
#ifndef BRUME_OIT_LINKED_LIST_PIXELS_GLSL
#define BRUME_OIT_LINKED_LIST_PIXELS_GLSL
#include "../../common/bindings.glsl"
#include "../../gpu/address.glsl"
#include "lists.h"

layout(push_constant, scalar) uniform Push { ListPush push; };
layout(buffer_reference, scalar) buffer RecordArray { SurfaceRecord at[]; };
layout(buffer_reference, scalar) buffer SolidRecordArray { SolidRecord at[]; };
layout(buffer_reference, scalar) buffer WordArray { uint64_t at[]; };
layout(buffer_reference, scalar) buffer CounterBlock { ListCounters counters; };
layout(buffer_reference, scalar) readonly buffer BandBlock { ListBand band; };
layout(buffer_reference, scalar) readonly buffer TileArray { ListTile at[]; };

// -0 is 0.
uint distanceKey(float t) { return floatBitsToUint(t) & 0x7fffffffu; }

// Of a slot.
uint tileAt(uint slot) {
    return UintArray(push.tileMap).at[1u + frame.tiles.x * frame.tiles.y + slot];
}
// The workgroups of a dispatch or its invocations may be a few more than the band has slots for:
// false for those.
bool findSlot(uint bandSlot, out uint slot, out uint tile) {
    ListBand band = BandBlock(push.band).band;
    slot = band.firstSlot + min(bandSlot, max(band.slotCount, 1u) - 1u);
    tile = tileAt(slot);
    return bandSlot < band.slotCount;
}

// False where the pixel's tile has no lists in this band; else its slot, and its place therein.
// `isOneBand`: it has all tiles that have any. `isEveryTile`: all have, and slots are tiles.
bool findPixel(uvec2 pixel, bool isOneBand, bool isEveryTile, out uint slot, out uint inside) {
    uvec2 position = pixel / kTileSize;
    uint tile = position.y * frame.tiles.x + position.x;
    inside = pixel.y % kTileSize * kTileSize + pixel.x % kTileSize;
    slot = isEveryTile ? tile : UintArray(push.tileMap).at[1u + tile];
    if (isOneBand) return isEveryTile || slot != ~0u;
    ListBand band = BandBlock(push.band).band;
    return slot - band.firstSlot < band.slotCount;
}

// Of the slot's tile: its entries, and the address of its records.
Uvec2Array entriesOf(uint slot) {
    return Uvec2Array(push.lists +
                      uint64_t(TileArray(push.tiles).at[slot].firstBlock) * kBlockBytes);
}
uint64_t recordsOf(uint slot) {
    return push.lists + uint64_t(TileArray(push.tiles).at[slot].recordBlock) * kBlockBytes;
}

#endif
