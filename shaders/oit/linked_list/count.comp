// SPDX-License-Identifier: Apache-2.0
// Counts the medium intervals of each pixel, a slice of the media at a time, and adds the surfaces
// counted before.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "media.glsl"

void main() {
    uint tile, firstPixel;
    if (!beginColumn(tile, firstPixel)) return;
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
    for (uint row = 0u; row < kRows; ++row) {
        uint pixel = firstPixel + row * kTileSize;
        if (kSurfaces && push.step == 0u)
            counts[row] += UintArray(push.surfaceOffsets).at[pixel];
        UintArray(push.offsets).at[pixel] += counts[row];
    }
}
