// SPDX-License-Identifier: Apache-2.0
// Per-pixel lists of thin surfaces and medium intervals; C++ and GLSL.
#ifndef BRUME_SHADERS_OIT_LINKED_LIST_LISTS_H
#define BRUME_SHADERS_OIT_LINKED_LIST_LISTS_H
#include "../../common/shared.h"

BRUME_STRUCTS_BEGIN

// A list entry is a uvec2: the bits of the distance at which it begins (a float >= 0, so that they
// sort as an integer), and kind << kKindShift | index. Pixels are numbered tile by tile from the
// band's first tile, 64 to a tile, row by row; the entries of pixel p are
// entries[offsets[p] .. offsets[p + 1]), the surfaces last until they are sorted; its surface
// records are records[surfaceOffsets[p] .. surfaceOffsets[p + 1]).
BRUME_CONST uint kKindShift = 30u;
BRUME_CONST uint kKindSphere = 0u;   // index into the sorted spheres
BRUME_CONST uint kKindBox = 1u;      // index into the boxes
BRUME_CONST uint kKindSurface = 2u;  // index into the surface records
BRUME_CONST uint kIndexMask = 0x3fffffffu;

struct ListPush {
    uint meshIndex;                       // surface passes: which mesh is drawn
    uint firstTile;                       // of the band
    uint tileCount;                       // in the band
    uint64_t entries;                     // uvec2[]
    uint64_t offsets;                     // uint[pixels + 1]: counts until they are summed
    uint64_t surfaceOffsets;              // uint[pixels + 1]: counts until they are summed
    uint64_t surfaceCursors;              // uint[pixels]: how many surfaces are stored already
    uint64_t records;                     // SurfaceRecord[]
    uint64_t sphereOffsets, spherePairs;  // uint[tiles + 1], uint[]
    uint64_t boxOffsets, boxPairs;
    uint64_t counters;  // ListCounters
};

// What a triangle leaves in a list.
struct SurfaceRecord {
    vec3 radiance;      // thin: reflected and emitted, not multiplied by the coverage
    float coverage;     // thin
    vec3 transmission;  // thin; solid: extinction, 1/m
    vec3 scattering;    // solid: 1/m
    uint face;          // kFaceThin, kFaceFront, kFaceBack
    uint rank;          // breaks ties between equal distances
};

BRUME_CONST uint kFaceThin = 0u;
BRUME_CONST uint kFaceFront = 1u;  // of a solid: the ray enters
BRUME_CONST uint kFaceBack = 2u;   // the ray leaves

struct ListCounters {
    uint exhausted;  // pixels that reached kMaxIterations: the image is not exact, the host must
                     // say so
};

struct TileTotals {
    uint entries;
    uint surfaces;
    uint longest;
};

// Loop iterations after which a pixel gives up: one software rasteriser stops silently at 65 535.
BRUME_CONST uint kMaxIterations = 64000u;

// Media that the resolve works out once per ray where nothing varies along it.
BRUME_CONST uint kKeptMedia = 4u;

// Own bindings.
BRUME_CONST uint kBindingResult = 8u;  // RGBA32F, written by resolve

BRUME_STRUCTS_END

#ifdef __cplusplus
static_assert(sizeof(brume::shader::ListPush) == 96);
static_assert(sizeof(brume::shader::SurfaceRecord) == 48);
#endif
#endif
