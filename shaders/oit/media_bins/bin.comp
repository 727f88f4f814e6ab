// SPDX-License-Identifier: Apache-2.0
// Counts the media of each tile, or scatters their indices to the tiles' lists.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/bindings.glsl"
#include "../../gpu/address.glsl"
#include "bins.h"
#include "rect.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kScatter = false;
layout(constant_id = 1) const uint kKeys = kKeysNothing;
layout(push_constant, scalar) uniform Push { BinPush push; };
layout(buffer_reference, scalar) readonly buffer SphereArray { SphereData at[]; };

// No ray meets the medium before this distance.
float smallestDistance(uint i) {
    if (kKeys == kKeysNothing) return 0.0;
    uint key = UintArray(push.keys).at[i];
    // Keys of boxes are made to sort negative distances too.
    float distance = uintBitsToFloat(kKeys == kKeysOfBoxes ? key & 0x7fffffffu : key);
    return distance * (1.0 - 1e-5);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    uvec2 rect = Uvec2Array(push.rects).at[i];
    if (rect == kNoRect) return;
    uvec2 first = uvec2(rect.x & 0xffffu, rect.x >> 16),
          last = uvec2(rect.y & 0xffffu, rect.y >> 16);
    float nearest = smallestDistance(i);
    const bool kAreSpheres = kKeys == kKeysOfSpheres;
    SphereData sphere;
    if (kAreSpheres) sphere = SphereArray(push.spheres).at[i];
    vec3 view = kAreSpheres ? cameraCoordinates(sphere.center) : vec3(0);
    uint slices = push.rowSlices;
    uint start = first.y + (gl_GlobalInvocationID.y + slices - first.y % slices) % slices;
    for (uint y = start; y <= last.y; y += slices)
        for (uint x = first.x; x <= last.x; ++x) {
            uint tile = y * frame.tiles.x + x;
            if (nearest > FloatArray(push.limits).at[tile]) continue;
            if (kAreSpheres && isBesideTile(view, sphere.radius, uvec2(x, y))) continue;
            if (kScatter) {
                uint slot = UintArray(push.counts).at[tile] +
                            atomicAdd(UintArray(push.cursors).at[tile], 1u);
                if (slot < UintArray(push.counts).at[tile + 1u]) UintArray(push.pairs).at[slot] = i;
            } else {
                atomicAdd(UintArray(push.counts).at[tile], 1u);
            }
        }
}
