// SPDX-License-Identifier: Apache-2.0
// Media sorted by distance and binned to screen tiles; C++ and GLSL.
#ifndef BRUME_SHADERS_OIT_MEDIA_BINS_H
#define BRUME_SHADERS_OIT_MEDIA_BINS_H
#include "../../common/shared.h"

BRUME_STRUCTS_BEGIN

struct BinPush {
    uint64_t keys;     // uint[count]: sort keys, or ids to sort by first
    uint64_t values;   // uint[count]: indices in sorted order
    uint64_t rects;    // uvec2[count]: first and last tile, x | y << 16; first > last: not visible
    uint64_t counts;   // uint[tiles]: how many media touch each tile; when scattering, the offsets
                       // that fit the memory, uint[tiles + 1]
    uint64_t cursors;  // uint[tiles]: how many are scattered already
    uint64_t pairs;    // uint[]: indices of the media of each tile
    uint64_t spheres;  // SphereData[count], if those are binned
    uint64_t limits;   // float[tiles]: m, what begins behind is hidden by something opaque
    uint count;
    uint rowSlices;
};

// What the lists of a frame want, whether there is memory for it or not.
struct BinTotals {
    uint pairs;    // of tile and medium
    uint longest;  // list
};

struct FitPush {
    uint64_t wanted;  // uint[tiles + 1]: where each tile's list would begin
    uint64_t fitted;  // uint[tiles + 1]: where it begins, so that all end within the memory
    uint64_t totals;  // BinTotals
    uint tileCount;
    uint capacity;    // pairs
};

// One invocation bins one medium to the tile rows y with y % rowSlices == its slice. Devices that
// hand out invocations in order, such as llvmpipe, scatter in order then, and sorting is cheap.
// A loop of one that covers the whole screen must stay short: some devices silently end all loops
// of an invocation after 65 535 iterations.
BRUME_CONST uint kBinMostTiles = 30000u;

// What the sorted keys say of how near a medium can be, to bin.comp.
BRUME_CONST uint kKeysNothing = 0u;
BRUME_CONST uint kKeysOfSpheres = 1u;  // bits of the smallest distance
BRUME_CONST uint kKeysOfBoxes = 2u;    // likewise; perspective only

// Own bindings.
BRUME_CONST uint kBindingSortedSpheres = 8u;  // SphereData[], written by gather
BRUME_CONST uint kBindingSortedBoxes = 8u;    // BoxData[], written by box_rects

BRUME_STRUCTS_END
#endif
