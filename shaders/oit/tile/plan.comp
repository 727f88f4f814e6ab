// SPDX-License-Identifier: Apache-2.0
// Lists the tiles of some classes, in any order: no tile's pixels depend on another's.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../gpu/address.glsl"
#include "tile.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kForLists = false;  // as tile map of ../linked_list/lists.h
layout(push_constant, scalar) uniform Push { TilePlanPush push; };

void main() {
    uint tile = gl_GlobalInvocationID.x;
    if (tile >= push.tileCount) return;
    bool isListed = (push.classMask >> UintArray(push.classes).at[tile] & 1u) != 0u;
    if (kForLists) UintArray(push.list).at[1u + tile] = ~0u;
    if (!isListed) return;
    uint slot = atomicAdd(UintArray(push.list).at[kForLists ? 0u : kTileListCount], 1u);
    uint first = kForLists ? 1u + push.tileCount : kTileListHead;
    UintArray(push.list).at[first + slot] = tile;
    if (kForLists) UintArray(push.list).at[1u + tile] = slot;
}
