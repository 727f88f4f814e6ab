// SPDX-License-Identifier: Apache-2.0
// Counts the tiles that each caster touches, or writes the pairs of tile and caster, in the order
// of the casters: no atomics, so that lists come out alike in every run.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "caster.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 1) const bool kWrite = false;

void main() {
    uint i = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u;
    if (i >= push.count) return;
    ShadowMap map = ShadowMapRef(push.map).map;
    uint index = UintArray(push.order).at[i];
    Caster caster = loadCaster(map, index);
    uint tiles = map.resolution / kMapTileSize;
    uint pair = kWrite ? UintArray(push.offsets).at[i] : 0u;
    for (uint face = 0u; face < map.faceCount; ++face) {
        uvec2 first, last;
        findTiles(map, caster, face, first, last);
        if (!kWrite) {
            pair += first.x <= last.x ? (last.x - first.x + 1u) * (last.y - first.y + 1u) : 0u;
            continue;
        }
        for (uint y = first.y; y <= last.y; ++y)
            for (uint x = first.x; x <= last.x; ++x) {
                if (pair < push.capacity) {
                    UintArray(push.keys).at[pair] = (face * tiles + y) * tiles + x;
                    UintArray(push.values).at[pair] = index;
                }
                ++pair;
            }
    }
    if (!kWrite) UintArray(push.offsets).at[i] = pair;
}
