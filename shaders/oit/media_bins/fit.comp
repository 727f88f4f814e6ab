// SPDX-License-Identifier: Apache-2.0
// Fits the tiles' lists into their memory. Where it is too small, each tile keeps the same share of
// its list, of which the scatter then fills in the media that stand first: the nearest, nearly.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../gpu/address.glsl"
#include "bins.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { FitPush push; };
layout(buffer_reference, scalar) buffer TotalsBlock { BinTotals totals; };

void main() {
    uint tile = gl_GlobalInvocationID.x;
    if (tile > push.tileCount) return;
    uint total = UintArray(push.wanted).at[push.tileCount];
    uint begin = UintArray(push.wanted).at[tile];
    uint end = UintArray(push.wanted).at[min(tile + 1u, push.tileCount)];
    uint64_t share = uint64_t(begin) * push.capacity / max(total, 1u);
    UintArray(push.fitted).at[tile] = total > push.capacity ? uint(share) : begin;
    atomicMax(TotalsBlock(push.totals).totals.longest, end - begin);
    if (tile == push.tileCount) TotalsBlock(push.totals).totals.pairs = total;
}
