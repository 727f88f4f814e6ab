// SPDX-License-Identifier: Apache-2.0
// Stores the medium intervals of each pixel, sorted by the distance at which they begin, a slice of
// the media at a time. The media come nearly sorted, so that most intervals are appended; where
// that would take too long, sorting is left to resolve. Where a list has less room than its pixel
// has media, the nearest stay.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "media.glsl"

layout(constant_id = 3) const bool kMayLackRoom = true;

Uvec2Array entries;
uint begins[kRows];
uint ends[kRows];
uint limits[kRows];  // that the list may not reach beyond
uint lastKeys[kRows];
bool isUnsorted = false;  // some list of the column
uint shifts = 0u;

bool isBefore(uvec2 a, uvec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

// Makes room for an entry in a full list by giving up the farthest; false if that is the new one.
bool makeRoom(uint row, uvec2 entry) {
    if (ends[row] < limits[row]) return true;
    if (isUnsorted || ends[row] == begins[row] || !isBefore(entry, entries.at[ends[row] - 1u]))
        return false;
    --ends[row];
    return true;
}

void storeInterval(uint row, uvec2 entry) {
    if (kMayLackRoom && !makeRoom(row, entry)) return;
    uint slot = ends[row];
    // Equal distances stand in the order of kind and index, which does not depend on the order of
    // submission.
    bool isLast = entry.x > lastKeys[row] || slot == begins[row];
    uint limit = isLast || isUnsorted ? slot : begins[row];
    isUnsorted = isUnsorted || shifts > kShiftsPerSlice;
    while (slot > limit) {
        ++shifts;
        uvec2 previous = entries.at[slot - 1u];
        if (isBefore(previous, entry)) break;
        entries.at[slot] = previous;
        --slot;
    }
    entries.at[slot] = entry;
    lastKeys[row] = max(lastKeys[row], entry.x);
    ++ends[row];
}

void main() {
    uint tile, firstSlot, column;
    if (!beginColumn(tile, firstSlot, column)) return;
    entries = entriesOf(firstSlot);
    uint firstPixel = firstSlot * 64u + column;
    for (uint row = 0u; row < kRows; ++row) {
        uint pixel = column + row * kTileSize;
        uint progress = UintArray(push.progress).at[firstPixel + row * kTileSize];
        uint at = firstSlot * kTileOffsets + pixel;
        begins[row] = UintArray(push.offsets).at[at];
        limits[row] = UintArray(push.offsets).at[at + 1u];
        if (kSurfaces)
            limits[row] -=
                UintArray(push.surfaceOffsets).at[at + 1u] - UintArray(push.surfaceOffsets).at[at];
        ends[row] = begins[row] + (progress & ~kUnsortedBit);
        lastKeys[row] = ends[row] > begins[row] ? entries.at[ends[row] - 1u].x : 0u;
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
