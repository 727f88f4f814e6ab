// SPDX-License-Identifier: Apache-2.0
// Where the pairs of each tile begin in the pairs sorted by tile.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../gpu/address.glsl"
#include "../common/maps.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { ShadowBinPush push; };

void main() {
    uint tile = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u;
    if (tile > push.tileCount) return;
    uint lo = 0u, hi = push.count;
    while (lo < hi) {
        uint middle = (lo + hi) / 2u;
        if (UintArray(push.keys).at[middle] < tile)
            lo = middle + 1u;
        else
            hi = middle;
    }
    UintArray(push.offsets).at[tile] = lo;
}
