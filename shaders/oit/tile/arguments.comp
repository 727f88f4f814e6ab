// SPDX-License-Identifier: Apache-2.0
// One invocation: how many workgroups of 64 invocations visit a list of tiles.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../gpu/address.glsl"
#include "tile.h"

layout(local_size_x = 1) in;
layout(push_constant, scalar) uniform Push { TilePlanPush push; };

// Devices allow at least 65 535 workgroups to each side.
void storeGroups(uint at, uint threads) {
    uint groups = (threads + 63u) / 64u;
    uint rows = max((groups + 65534u) / 65535u, 1u);
    UintArray(push.list).at[at] = (groups + rows - 1u) / rows;
    UintArray(push.list).at[at + 1u] = rows;
    UintArray(push.list).at[at + 2u] = 1u;
}

void main() {
    uint count = UintArray(push.list).at[kTileListCount];
    storeGroups(0u, count * push.threadsPerTile);
    storeGroups(kTileListPerTile, count);
}
