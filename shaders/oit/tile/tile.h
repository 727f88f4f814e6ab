// SPDX-License-Identifier: Apache-2.0
// Media composited per screen tile, with all state in registers; C++ and GLSL.
#ifndef BRUME_SHADERS_OIT_TILE_H
#define BRUME_SHADERS_OIT_TILE_H
#include "../../common/shared.h"

BRUME_STRUCTS_BEGIN

struct TilePush {
    uint64_t tiles;                       // tile list: which to visit
    uint64_t sphereOffsets, spherePairs;  // uint[tiles + 1], uint[]
    uint64_t sphereEnds;  // uint[], the pairs in the order in which tiles with mixtures leave them
    uint64_t boxOffsets, boxPairs;
    uint64_t classes;   // uint[tiles], classify: largest class that a pixel needs
    uint64_t counters;  // TileCounters
    float epsilon;      // pixels stop at transmittances below it
    float largestTint;  // of all media
};

// A list of tiles in memory is an array of uint: the workgroups in x, y and z that visit them, as
// arguments of an indirect dispatch; likewise with one invocation per tile; how many tiles there
// are; these.
BRUME_CONST uint kTileListPerTile = 3u;
BRUME_CONST uint kTileListCount = 6u;
BRUME_CONST uint kTileListHead = 7u;

// How plan.comp and arguments.comp fill one.
struct TilePlanPush {
    uint64_t classes;      // uint[tiles]
    uint64_t list;         // tile list, or tile map of pixel lists
    uint tileCount;        // of the screen
    uint classMask;        // bits of the classes that go there
    uint threadsPerTile;
};

// What the pixels of a tile need, in rising order of cost.
BRUME_CONST uint kClassEmpty = 0u;    // no medium
BRUME_CONST uint kClassOrdered = 1u;  // media one behind the other, or of one common source
BRUME_CONST uint kClassVolumes = 2u;  // bricks and boxes of one medium; spheres of one source too
BRUME_CONST uint kClassMix = 3u;      // spheres of constant density that mix: with the first of the
                                      // sizes of windows, with the second ...
BRUME_CONST uint kClassLists = 9u;    // everything else: sorted lists of each pixel

struct TileCounters {
    uint stopped;    // invocations that stopped before their last medium
    uint bound;      // bits of the largest radiance that a pixel may be off for that
    uint exhausted;  // pixels at which the device may have ended the loops
};

// Media whose source the composite works out once per ray.
BRUME_CONST uint kTileMedia = 4u;

// Longer lists are left to the sorted lists of each pixel: some devices silently end all loops of
// an invocation after 65 535 iterations.
BRUME_CONST uint kTileLongestList = 30000u;

// Own bindings.
BRUME_CONST uint kBindingTileResult = 8u;  // RGBA32F

BRUME_STRUCTS_END

#ifdef __cplusplus
static_assert(sizeof(brume::shader::TilePush) == 72);
#endif
#endif
