// SPDX-License-Identifier: Apache-2.0
// Counts the medium intervals of each pixel, a slice of the media at a time.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "media.glsl"

void main() {
    uint tile, slot, column;
    if (!beginColumn(tile, slot, column)) return;
    uint counts[kRows];
    for (uint row = 0u; row < kRows; ++row) counts[row] = 0u;
    vec2 t;
    if (kSpheres) {
        uint k = UintArray(push.sphereOffsets).at[tile];
        uint last = UintArray(push.sphereOffsets).at[tile + 1u];
        for (sliceMedia(k, last); k < last; ++k) {
            SphereData sphere = spheres[UintArray(push.spherePairs).at[k]];
            for (uint row = 0u; row < kRows; ++row)
                counts[row] += hitsSphere(sphere, row, t) ? 1u : 0u;
        }
    }
    if (kBoxes) {
        uint k = UintArray(push.boxOffsets).at[tile];
        uint last = UintArray(push.boxOffsets).at[tile + 1u];
        for (sliceMedia(k, last); k < last; ++k) {
            BoxData box = boxes[UintArray(push.boxPairs).at[k]];
            VolumeData volume = volumes[box.volume];
            for (uint row = 0u; row < kRows; ++row)
                counts[row] += hitsBox(box, volume, row, t) ? 1u : 0u;
        }
    }
    uint first = slot * kTileOffsets + column;
    for (uint row = 0u; row < kRows; ++row)
        UintArray(push.offsets).at[first + row * kTileSize] += counts[row];
}
