// SPDX-License-Identifier: Apache-2.0
// Eight pixels below each other per invocation, eight tiles per workgroup: a medium is loaded once
// for all of a column.
#ifndef BRUME_OIT_TILE_COLUMN_GLSL
#define BRUME_OIT_TILE_COLUMN_GLSL
#include "media.glsl"

const uint kRows = kTileSize;

uvec2 corner;  // the column's topmost pixel
RealRay rays[kRows];
float limits[kRows];  // distance of the opaque surface; < 0 outside the image

// False behind the last tile.
bool beginColumn(out uint tile) {
    uint thread = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u;
    uint slot = thread / kTileSize;
    if (slot >= tileCount()) return false;
    tile = tileAt(slot);
    corner = tileCorner(tile) + uvec2(thread % kTileSize, 0u);
    [[unroll]] for (uint row = 0u; row < kRows; ++row) {
        uvec2 pixel = corner + uvec2(0u, row);
        bool inside = all(lessThan(pixel, frame.size));
        rays[row] = makeTileRay(pixel);
        limits[row] = inside ? texelFetch(opaqueT, ivec2(pixel), 0).x : -1.0;
    }
    return true;
}

#endif
