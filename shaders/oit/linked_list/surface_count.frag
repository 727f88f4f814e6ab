// SPDX-License-Identifier: Apache-2.0
// Counts the fragments of thin and solid surfaces. Solids count behind opaque surfaces too: their
// exits tell whether the eye is inside.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/opaque.glsl"
#include "../../common/surface.glsl"
#include "pixels.glsl"

layout(constant_id = kListConstantEveryTile) const bool kEveryTile = false;

void main() {
    SurfacePoint point = findSurfacePoint();
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    bool isSeen = isSolid(point) || mayBeInFront(point.t, ivec2(pixel));
    uint slot, inside;
    if (!isSeen || !findPixel(pixel, true, kEveryTile, slot, inside)) return;
    atomicAdd(UintArray(push.surfaceOffsets).at[slot * kTileOffsets + inside], 1u);
}
