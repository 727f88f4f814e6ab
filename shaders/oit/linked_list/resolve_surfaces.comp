// SPDX-License-Identifier: Apache-2.0
// Composites lists of thin surfaces alone, front to back: the eight nearest that are left are found in
// registers, in one walk over the list, and crossed. Nothing is written but the pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "pixels.glsl"

layout(constant_id = kListConstantColoured) const bool kColoured = true;
layout(constant_id = kListConstantOneBand) const bool kOneBand = false;
layout(constant_id = kListConstantEveryTile) const bool kEveryTile = false;
const bool kSolids = false;
#include "surfaces.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = kBindingOpaqueColor) uniform sampler2D opaqueColor;
layout(binding = kBindingResult, rgba32f) writeonly uniform image2D result;

const uint kNearest = 8u;

// A place in the order of crossing: by distance; equal ones by rank; and those whose ranks are equal
// too, which are of one colour as a rule, as they stand in the list.
struct Key {
    uint distance;
    uint rank;
    uint index;
};
const Key kLastKey = Key(~0u, ~0u, ~0u);

bool isBefore(Key a, Key b) {
    return a.distance < b.distance || (a.distance == b.distance && a.rank < b.rank);
}
bool isAfter(Key a, Key b) {
    return isBefore(b, a) || (a.distance == b.distance && a.rank == b.rank && a.index > b.index);
}

// From a word to the same of the next surface.
const uint kStep = (kColoured ? kThinRecordWords : kGreyRecordWords) * kTileSize;

vec2 floatsAt(uint word) {
    return uintBitsToFloat(unpackUint2x32(WordArray(push.lists).at[word]));
}

Key loadKey(uint word) {
    uvec2 place = unpackUint2x32(WordArray(push.lists).at[word]);
    return Key(place.y, place.x, word);
}

void crossRecord(inout Path path, uint word) {
    vec2 redGreen = floatsAt(word + kTileSize), blueLoss = floatsAt(word + 2u * kTileSize);
    vec3 loss = vec3(blueLoss.y);
    if (kColoured) loss.gb = floatsAt(word + 3u * kTileSize);
    crossSurface(path, vec3(redGreen, blueLoss.x), loss);
}

// The nearest of list[first .. end) behind `last`, in order.
void findNearest(uint first, uint end, bool isBegin, Key last, out Key nearest[kNearest]) {
    [[unroll]] for (uint k = 0u; k < kNearest; ++k) nearest[k] = kLastKey;
    for (uint i = first; i < end; i += kStep) {
        Key key = loadKey(i);
        if (!isBegin && !isAfter(key, last)) key = kLastKey;
        [[unroll]] for (uint k = 0u; k < kNearest; ++k) {
            Key other = nearest[k];
            bool isNearer = isBefore(key, other);
            nearest[k].distance = isNearer ? key.distance : other.distance;
            nearest[k].rank = isNearer ? key.rank : other.rank;
            nearest[k].index = isNearer ? key.index : other.index;
            key.distance = isNearer ? other.distance : key.distance;
            key.rank = isNearer ? other.rank : key.rank;
            key.index = isNearer ? other.index : key.index;
        }
    }
}

void main() {
    uint group = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
    uint slot = group, tile = group;
    bool isInBand = kOneBand && kEveryTile ? tile < frame.tiles.x * frame.tiles.y
                                           : findSlot(group, slot, tile);
    uvec2 pixel = tileCorner(tile) + gl_LocalInvocationID.xy;
    if (!isInBand || any(greaterThanEqual(pixel, frame.size))) return;
    uint first =
        UintArray(push.surfaceOffsets).at[slot * kTileOffsets + gl_LocalInvocationIndex];
    uint end = UintArray(push.surfaceCursors).at[slot * 64u + gl_LocalInvocationIndex];
    Path path = beginPath();
    Key nearest[kNearest], last = kLastKey;
    for (uint crossed = first; crossed < end; crossed += kNearest * kStep) {
        findNearest(first, end, crossed == first, last, nearest);
        [[unroll]] for (uint k = 0u; k < kNearest; ++k)
            if (nearest[k].index != kLastKey.index) crossRecord(path, nearest[k].index);
        last = nearest[kNearest - 1u];
    }
    vec3 behind = texelFetch(opaqueColor, ivec2(pixel), 0).rgb;
    imageStore(result, ivec2(pixel), vec4(path.radiance + path.surfaces * behind, 1.0));
    if (end - first > kLongestOfSurfaces * kStep)
        atomicAdd(CounterBlock(push.counters).counters.exhausted, 1u);
}
