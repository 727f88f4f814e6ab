// SPDX-License-Identifier: Apache-2.0
// Stores the medium intervals of each pixel, sorted by the distance at which they begin, a slice of
// the media at a time. The media come nearly sorted, so that most intervals are appended; where
// that would take too long, sorting is left to resolve.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "media.glsl"

uint begins[kRows];
uint ends[kRows];
uint lastKeys[kRows];
bool isUnsorted = false;  // some list of the column
uint shifts = 0u;

void storeInterval(uint row, uvec2 entry) {
    uint slot = ends[row];
    // Equal distances stand in the order of kind and index, which does not depend on the order of
    // submission.
    bool isLast = entry.x > lastKeys[row] || slot == begins[row];
    uint limit = isLast || isUnsorted ? slot : begins[row];
    isUnsorted = isUnsorted || shifts > kShiftsPerSlice;
    while (slot > limit) {
        ++shifts;
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
        uint pixel = firstPixel + row * kTileSize;
        uint progress = UintArray(push.progress).at[pixel];
        begins[row] = UintArray(push.offsets).at[pixel];
        ends[row] = begins[row] + (progress & ~kUnsortedBit);
        lastKeys[row] =
            ends[row] > begins[row] ? Uvec2Array(push.entries).at[ends[row] - 1u].x : 0u;
        isUnsorted = isUnsorted || (progress & kUnsortedBit) != 0u;
    }
    vec2 t;
    if (kSpheres) {
        uint k = UintArray(push.sphereOffsets).at[tile];
        uint last = UintArray(push.sphereOffsets).at[tile + 1u];
        for (sliceMedia(k, last); k < last; ++k) {
            uint index = UintArray(push.spherePairs).at[k];
            SphereData sphere = spheres[index];
            for (uint row = 0u; row < kRows; ++row)
                if (hitsSphere(sphere, row, t))
                    storeInterval(row, uvec2(distanceKey(t.x), kKindSphere << kKindShift | index));
        }
    }
    if (kBoxes) {
        uint k = UintArray(push.boxOffsets).at[tile];
        uint last = UintArray(push.boxOffsets).at[tile + 1u];
        for (sliceMedia(k, last); k < last; ++k) {
            uint index = UintArray(push.boxPairs).at[k];
            BoxData box = boxes[index];
            VolumeData volume = volumes[box.volume];
            for (uint row = 0u; row < kRows; ++row)
                if (hitsBox(box, volume, row, t))
                    storeInterval(row, uvec2(distanceKey(t.x), kKindBox << kKindShift | index));
        }
    }
    for (uint row = 0u; row < kRows; ++row)
        UintArray(push.progress).at[firstPixel + row * kTileSize] =
            (ends[row] - begins[row]) | (isUnsorted ? kUnsortedBit : 0u);
}
