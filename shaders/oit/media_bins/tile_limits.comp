// SPDX-License-Identifier: Apache-2.0
// How far each tile can be looked into: the largest distance of what is opaque in its pixels.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/bindings.glsl"
#include "../../gpu/address.glsl"
#include "bins.h"

layout(local_size_x = 64) in;
layout(binding = kBindingOpaqueT) uniform sampler2D opaqueT;
layout(push_constant, scalar) uniform Push { BinPush push; };
layout(buffer_reference, scalar) writeonly buffer Limits { float at[]; };

void main() {
    uint tile = gl_GlobalInvocationID.x;
    if (tile >= frame.tiles.x * frame.tiles.y) return;
    uvec2 corner = tileCorner(tile);
    uvec2 end = min(corner + kTileSize, frame.size);
    float limit = 0.0;
    for (uint y = corner.y; y < end.y; ++y)
        for (uint x = corner.x; x < end.x; ++x)
            limit = max(limit, texelFetch(opaqueT, ivec2(x, y), 0).x);
    Limits(push.limits).at[tile] = limit;
}
