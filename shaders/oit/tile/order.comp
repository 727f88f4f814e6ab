// SPDX-License-Identifier: Apache-2.0
// Lists the spheres of a tile by where the ray through its middle enters them (in place), and by
// where it leaves them. Each list goes through a sorted window of fixed size, of which the smallest
// leaves: enough where nearly sorted. What is farther from its place than that stays so;
// overlaps.comp finds it out.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "order.glsl"

layout(constant_id = 6) const uint kWindow = 16u;  // spheres; the time grows with their number

// Begins, and ends.
float keys[2u * kWindow];
uint indices[2u * kWindow];

// Puts a sphere into a window, which falls from its first to its last place, and returns the
// smallest.
uint exchange(uint window, float key, uint index) {
    [[unroll]] for (uint i = 0u; i < kWindow; ++i) {
        uint slot = window * kWindow + i;
        bool isBefore = keys[slot] < key;
        float kept = isBefore ? key : keys[slot];
        uint keptIndex = isBefore ? index : indices[slot];
        key = isBefore ? keys[slot] : key;
        index = isBefore ? indices[slot] : index;
        keys[slot] = kept;
        indices[slot] = keptIndex;
    }
    return index;
}

void main() {
    uint slot = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u;
    if (slot >= tileCount()) return;
    uint tile = tileAt(slot);
    RealRay ray = makeMiddleRay(tile);
    uint first = UintArray(push.sphereOffsets).at[tile];
    uint size = UintArray(push.sphereOffsets).at[tile + 1u] - first;
    [[unroll]] for (uint i = 0u; i < 2u * kWindow; ++i) {
        keys[i] = -3e38;
        indices[i] = 0u;
    }
    for (uint k = 0u; k < size + kWindow; ++k) {
        uint index = UintArray(push.spherePairs).at[first + min(k, size - 1u)];
        SphereData sphere = spheres[index];
        bool isThere = k < size;
        uint entered = exchange(0u, isThere ? middleDistance(ray, sphere, false) : 3e38, index);
        uint left = exchange(1u, isThere ? middleDistance(ray, sphere, true) : 3e38, index);
        if (k < kWindow) continue;
        UintArray(push.spherePairs).at[first + k - kWindow] = entered;
        UintArray(push.sphereEnds).at[first + k - kWindow] = left;
    }
}
