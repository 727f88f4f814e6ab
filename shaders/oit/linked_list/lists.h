// SPDX-License-Identifier: Apache-2.0
// Per-pixel lists of thin surfaces and medium intervals; C++ and GLSL.
#ifndef BRUME_SHADERS_OIT_LINKED_LIST_LISTS_H
#define BRUME_SHADERS_OIT_LINKED_LIST_LISTS_H
#include "../../common/shared.h"
#include "../integrate/path.h"

BRUME_STRUCTS_BEGIN

// A list entry is a uvec2: the bits of the distance at which it begins (a float >= 0, so that they
// sort as an integer), and kind << kKindShift | index. The tiles that have lists are numbered by
// slots; slot s owns a run of blocks (ListTile), first entries, then surface records. Pixels are
// numbered slot by slot, 64 to a tile, row by row. The entries of pixel i of a slot are
// entries[offsets[i] .. offsets[i + 1]) of the tile's, media first, then surfaces, each sorted; its
// records are records[surfaceOffsets[i] .. surfaceCursors[pixel]) of the tile's; the next pixel's begin
// at surfaceOffsets[i + 1], which may be behind that cursor or, where room was lacking, before it.
// Where lists have no entries, both are words of 64 bits, from the begin of the memory.
BRUME_CONST uint kKindShift = 30u;
BRUME_CONST uint kKindSphere = 0u;   // index into the sorted spheres
BRUME_CONST uint kKindBox = 1u;      // index into the boxes
BRUME_CONST uint kKindSurface = 2u;  // index into the tile's surface records
BRUME_CONST uint kIndexMask = 0x3fffffffu;

BRUME_CONST uint kBlockBytes = 64u;
BRUME_CONST uint kEntryBytes = 8u;
BRUME_CONST uint kRecordBytes = 32u;       // of SurfaceRecord
BRUME_CONST uint kSolidRecordBytes = 60u;  // of SolidRecord
BRUME_CONST uint kTileOffsets = 65u;  // of a slot: those of 64 pixels, and the end

struct ListPush {
    uint step;         // surface passes: which mesh is drawn; count, store: first medium of the
                       // slice of a tile's media to visit; resolve: the round, from 0
    uint roundCount;   // resolve
    float epsilon;     // resolve: radiance that may be missing where a pixel stops early; 0: none
    float largestTint;  // of all media
    uint64_t band;      // ListBand: the slots to visit
    uint64_t tileMap;   // uint: how many slots; uint[screen tiles]: slot of each, or ~0; then
                        // uint[slots]: the screen tile of each
    uint64_t tiles;     // ListTile[slots]
    uint64_t lists;     // blocks
    uint64_t offsets;   // uint[kTileOffsets slots]: counts of media until they are summed
    uint64_t surfaceOffsets;              // likewise, of surfaces
    uint64_t surfaceCursors;              // uint[pixels]: where the next surface goes
    uint64_t sphereOffsets, spherePairs;  // uint[tiles + 1], uint[]
    uint64_t boxOffsets, boxPairs;
    uint64_t counters;  // ListCounters
    uint64_t progress;  // uint[pixels]: media stored already, and kUnsortedBit
    uint64_t states;    // PixelState[pixels]: where unfinished pixels go on in the next round
};

// Where a tile's lists are.
struct ListTile {
    uint firstBlock;   // of its entries, in the memory of its band
    uint recordBlock;  // of its surface records
};

// Slots whose lists are in memory together, and how many workgroups visit them: arguments of
// indirect dispatches. Band 0 stands for all slots.
struct ListBand {
    uvec3 columns;       // an invocation per column of eight pixels
    uvec3 laterColumns;  // the same, none where the first slice of the media is all
    uvec3 pixels;        // a workgroup per tile
    uvec3 slots;         // an invocation per tile
    uint firstSlot;
    uint slotCount;
};

// Some devices silently end all loops of an invocation after 65 535 iterations (counted for eight
// or so invocations in lock step). So no dispatch may need more: count and store visit the media
// of a tile in slices, and pixels with much to do are resolved in several rounds.
BRUME_CONST uint kMediaPerSlice = 512u;        // spheres and boxes each
BRUME_CONST uint kShiftsPerSlice = 5000u;      // that an invocation of store spends on sorting
BRUME_CONST uint kIterationsPerRound = 8000u;  // after which a pixel waits for the next round
BRUME_CONST uint kUnsortedBit = 0x80000000u;   // in progress: resolve has to sort the media

// What a triangle leaves in a list: L <- radiance + (1 - loss) L.
struct SurfaceRecord {
    vec3 radiance;     // that it adds by itself: coverage times reflected and emitted; solid: mirrored
    vec3 loss;         // thin: coverage (1 - transmission); solid: share of light that the face mirrors
    uint rank;         // breaks ties between equal distances
    float distanceLo;  // what rounding has taken from the distance in the entry
};

// The same in scenes with solids.
struct SolidRecord {
    SurfaceRecord surface;
    vec3 extinction;  // 1/m
    vec3 scattering;  // 1/m
    uint face;        // kFaceThin, kFaceFront, kFaceBack
};

// Lists of thin surfaces alone that are short enough for resolve_surfaces.comp have no entries, and
// records of words of 64 bits, because some devices write word by word what they write: rank and
// distance, red and green radiance, blue radiance and (red) loss, green and blue loss unless all
// channels are alike; the first of each pair is the lower half. The words of the eight pixels of a
// tile's row are one behind the other, in a block, so that neighbours share lines of the cache: a row
// has room for eight times its longest list, and a pixel's next word is kTileSize words behind.
BRUME_CONST uint kGreyRecordWords = 3u;
BRUME_CONST uint kThinRecordWords = 4u;

BRUME_CONST uint kFaceThin = 0u;
BRUME_CONST uint kFaceFront = 1u;  // of a solid: the ray enters
BRUME_CONST uint kFaceBack = 2u;   // the ray leaves

// How far a pixel is resolved.
struct PixelState {
    uint stage;    // kStage...
    uint at;       // sorting: next step
    uint medium;   // next entries to be met: of the media,
    uint surface;  // of the surfaces
    uint open;     // see constant.glsl and varying.glsl
    uint openBoxes;
    float position;    // of the last event
    float positionLo;  // what rounding has taken from it
    float offset;      // distance behind it
    float stepLimit;
    Path path;
    Sums solids;
    Sums media;  // constant
};

BRUME_CONST uint kStageSortMedia = 0u;
BRUME_CONST uint kStageSortSurfaces = 1u;
BRUME_CONST uint kStageWalk = 2u;
BRUME_CONST uint kStageDone = 3u;
BRUME_CONST uint kStageLost = 4u;  // the device has ended loops by itself

// Of one frame. Sums of 64 bits are two words, the low one first.
struct ListCounters {
    uint exhausted;    // pixels unfinished after the last round: the image is not exact, the host
                       // must say so
    uint stopped;      // pixels that stopped early
    uint bound;        // bits of the largest radiance that one of them may miss
    uint slots;        // tiles that have lists
    uint blocks;       // that their lists want,
    uint largestTile;  // and those of the tile that wants most
    uint bands;        // that they take
    uint longest;      // list of a pixel
    uvec2 stored;      // entries
    uvec2 dropped;     // entries that had no room
    uvec2 surfaces;    // of the stored ones
};

// What totals.comp, place.comp and arguments.comp get to see: how the lists of a frame share the
// memory.
struct PlacePush {
    uint64_t tileMap, tiles, offsets, surfaceOffsets, surfaceCursors, counters;  // as in ListPush
    uint64_t blocks;     // uint[slots + 1]: what each tile wants; the sums of those before
    uint64_t bands;      // ListBand[bandCount + 1]
    uint64_t draws;      // DrawArguments[bandCount][drawCount]
    uint64_t binTotals;  // BinTotals[2]
    uint slotCapacity;
    uint bandCount;      // that are recorded
    uint blockCapacity;  // of the memory that they share
    uint drawCount;      // surfaces; 0: there are none
    uint recordBytes;    // of a surface
    uint recordWords;    // 0: lists have entries
};

// VkDrawIndirectCommand.
struct DrawArguments {
    uint vertices, instances, firstVertex, firstInstance;
};

// So many media the resolve loads once per ray, because on some devices a load from a buffer costs
// as much as forty operations.
BRUME_CONST uint kKeptMedia = 8u;

// Specialization constants of the passes that draw surfaces.
BRUME_CONST uint kListConstantMedia = 0u;     // bool: there are media
BRUME_CONST uint kListConstantOneBand = 1u;   // bool: all tiles' lists are in memory
BRUME_CONST uint kListConstantAlone = 2u;     // bool: lists without entries
BRUME_CONST uint kListConstantColoured = 3u;  // bool: losses differ between channels
BRUME_CONST uint kListConstantEveryTile = 4u;  // bool: all tiles have lists, slots are tiles

// So long a list may be for resolve_surfaces.comp, which goes through it once for each eight entries.
BRUME_CONST uint kLongestOfSurfaces = 240u;

// Own bindings.
BRUME_CONST uint kBindingResult = 8u;  // RGBA32F, written by resolve

BRUME_STRUCTS_END

#ifdef __cplusplus
static_assert(sizeof(brume::shader::ListPush) == 128);
static_assert(sizeof(brume::shader::PlacePush) == 104);
static_assert(sizeof(brume::shader::ListBand) == 56);
static_assert(sizeof(brume::shader::ListCounters) == 56);
static_assert(sizeof(brume::shader::SurfaceRecord) == brume::shader::kRecordBytes);
static_assert(sizeof(brume::shader::SolidRecord) == brume::shader::kSolidRecordBytes);
static_assert(sizeof(brume::shader::PixelState) == 216);
#endif
#endif
