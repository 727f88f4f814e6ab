// SPDX-License-Identifier: Apache-2.0
// Sums the counts of each tile, from which the host plans memory and bands.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/bindings.glsl"
#include "pixels.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kSurfaces = false;
layout(buffer_reference, scalar) writeonly buffer TotalArray { TileTotals at[]; };

void main() {
    uint tile = gl_GlobalInvocationID.x;
    if (tile >= push.tileCount) return;
    TileTotals totals = TileTotals(0u, 0u, 0u);
    for (uint i = 0u; i < 64u; ++i) {
        uint count = UintArray(push.offsets).at[tile * 64u + i];
        totals.entries += count;
        totals.longest = max(totals.longest, count);
        if (kSurfaces) totals.surfaces += UintArray(push.surfaceOffsets).at[tile * 64u + i];
    }
    TotalArray(push.counters).at[tile] = totals;
}
