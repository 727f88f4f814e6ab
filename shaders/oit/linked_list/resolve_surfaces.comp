// SPDX-License-Identifier: Apache-2.0
// Composites lists of thin surfaces alone, front to back: the eight nearest that are left are found in
// registers, in one walk over the list, and crossed. Nothing is written but the pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "pixels.glsl"

layout(constant_id = 0) const bool kColoured = true;  // losses differ between channels
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

uint64_t records;  // address

Key loadKey(uint i) {
    if (kColoured) {
        ThinRecord record = ThinRecordArray(records).at[i];
        return Key(distanceKey(record.distance), record.rank, i);
    }
    GreyRecord record = GreyRecordArray(records).at[i];
    return Key(distanceKey(record.distance), record.rank, i);
}

void crossRecord(inout Path path, uint i) {
    if (kColoured) {
        ThinRecord record = ThinRecordArray(records).at[i];
        crossSurface(path, record.radiance, record.loss);
    } else {
        GreyRecord record = GreyRecordArray(records).at[i];
        crossSurface(path, record.radiance, vec3(record.loss));
    }
}

// The nearest of list[first .. end) behind `last`, in order.
void findNearest(uint first, uint end, bool isBegin, Key last, out Key nearest[kNearest]) {
    [[unroll]] for (uint k = 0u; k < kNearest; ++k) nearest[k] = kLastKey;
    for (uint i = first; i < end; ++i) {
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
    uint slot, tile;
    bool isInBand = findSlot(gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x, slot, tile);
    uvec2 pixel =
        uvec2(tile % frame.tiles.x, tile / frame.tiles.x) * kTileSize + gl_LocalInvocationID.xy;
    if (!isInBand || any(greaterThanEqual(pixel, frame.size))) return;
    records = recordsOf(slot);
    uint at = slot * kTileOffsets + gl_LocalInvocationIndex;
    uint first = UintArray(push.surfaceOffsets).at[at];
    uint end = min(first + UintArray(push.surfaceCursors).at[slot * 64u + gl_LocalInvocationIndex],
                   UintArray(push.surfaceOffsets).at[at + 1u]);
    Path path = beginPath();
    Key nearest[kNearest], last = kLastKey;
    for (uint crossed = first; crossed < end; crossed += kNearest) {
        findNearest(first, end, crossed == first, last, nearest);
        [[unroll]] for (uint k = 0u; k < kNearest; ++k)
            if (nearest[k].index != kLastKey.index) crossRecord(path, nearest[k].index);
        last = nearest[kNearest - 1u];
    }
    vec3 behind = texelFetch(opaqueColor, ivec2(pixel), 0).rgb;
    imageStore(result, ivec2(pixel), vec4(path.radiance + path.surfaces * behind, 1.0));
    if (end - first > kLongestOfSurfaces)
        atomicAdd(CounterBlock(push.counters).counters.exhausted, 1u);
}
