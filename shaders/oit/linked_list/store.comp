// SPDX-License-Identifier: Apache-2.0
// Stores the medium intervals of each pixel, sorted by the distance at which they begin. The media
// come nearly sorted, so that most intervals are appended.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "media.glsl"

uint begins[kRows];
uint ends[kRows];
uint lastKeys[kRows];

void storeInterval(uint row, uvec2 entry) {
    uint slot = ends[row];
    // Equal distances stand in the order of kind and index, which does not depend on the order of
    // submission.
    bool sorted = entry.x > lastKeys[row] || slot == begins[row];
    uint limit = sorted ? slot : begins[row];
    while (slot > limit) {
        uvec2 previous = Uvec2Array(push.entries).at[slot - 1u];
        if (previous.x < entry.x || (previous.x == entry.x && previous.y < entry.y)) break;
        Uvec2Array(push.entries).at[slot] = previous;
        --slot;
    }
    Uvec2Array(push.entries).at[slot] = entry;
    lastKeys[row] = max(lastKeys[row], entry.x);
    ++ends[row];
}

void main() {
    uint tile, firstPixel;
    if (!beginColumn(tile, firstPixel)) return;
    for (uint row = 0u; row < kRows; ++row) {
        begins[row] = UintArray(push.offsets).at[firstPixel + row * kTileSize];
        ends[row] = begins[row];
        lastKeys[row] = 0u;
    }
    vec2 t;
    if (kSpheres) {
        uint last = UintArray(push.sphereOffsets).at[tile + 1u];
        for (uint k = UintArray(push.sphereOffsets).at[tile]; k < last; ++k) {
            uint index = UintArray(push.spherePairs).at[k];
            SphereData sphere = spheres[index];
            for (uint row = 0u; row < kRows; ++row)
                if (hitsSphere(sphere, row, t))
                    storeInterval(row,
                                  uvec2(floatBitsToUint(t.x), kKindSphere << kKindShift | index));
        }
    }
    if (kBoxes) {
        uint last = UintArray(push.boxOffsets).at[tile + 1u];
        for (uint k = UintArray(push.boxOffsets).at[tile]; k < last; ++k) {
            uint index = UintArray(push.boxPairs).at[k];
            BoxData box = boxes[index];
            VolumeData volume = volumes[box.volume];
            for (uint row = 0u; row < kRows; ++row)
                if (hitsBox(box, volume, row, t))
                    storeInterval(row, uvec2(floatBitsToUint(t.x), kKindBox << kKindShift | index));
        }
    }
}
