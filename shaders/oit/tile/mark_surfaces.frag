// SPDX-License-Identifier: Apache-2.0
// Marks the tiles in which thin or solid surfaces are seen. Solids count behind opaque surfaces
// too: their exits tell whether the eye is inside.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/opaque.glsl"
#include "../../common/surface.glsl"
#include "../../gpu/address.glsl"
#include "tile.h"

layout(push_constant, scalar) uniform Push { TilePush push; };

void main() {
    SurfacePoint point = findSurfacePoint();
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    if (!isSolid(point) && !mayBeInFront(point.t, ivec2(pixel))) return;
    uvec2 tile = pixel / kTileSize;
    atomicMax(UintArray(push.classes).at[tile.y * frame.tiles.x + tile.x], kClassLists);
}
