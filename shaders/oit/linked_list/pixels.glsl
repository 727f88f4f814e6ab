// SPDX-License-Identifier: Apache-2.0
// The order of pixels in the lists, and the arrays behind the push constants.
#ifndef BRUME_OIT_LINKED_LIST_PIXELS_GLSL
#define BRUME_OIT_LINKED_LIST_PIXELS_GLSL
#include "../../common/bindings.glsl"
#include "../../gpu/address.glsl"
#include "lists.h"

layout(push_constant, scalar) uniform Push { ListPush push; };
layout(buffer_reference, scalar) buffer RecordArray { SurfaceRecord at[]; };
layout(buffer_reference, scalar) buffer CounterBlock { ListCounters counters; };

// -0 is 0.
uint distanceKey(float t) { return floatBitsToUint(t) & 0x7fffffffu; }

// Slots of tiles count from the band's first.
uint tileAt(uint slot) {
    return UintArray(push.tileMap).at[frame.tiles.x * frame.tiles.y + push.firstSlot + slot];
}
uint bandSlot(uvec2 pixel) {
    uvec2 tile = pixel / kTileSize;
    return UintArray(push.tileMap).at[tile.y * frame.tiles.x + tile.x] - push.firstSlot;
}

uint pixelIndex(uvec2 pixel) {
    uvec2 inside = pixel % kTileSize;
    return bandSlot(pixel) * 64u + inside.y * kTileSize + inside.x;
}

bool isInBand(uvec2 pixel) { return bandSlot(pixel) < push.tileCount; }

#endif
