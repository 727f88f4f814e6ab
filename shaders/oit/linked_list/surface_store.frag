// SPDX-License-Identifier: Apache-2.0
// Stores the fragments of thin and solid surfaces: a record each, and an entry behind the media of
// the pixel, in the order of arrival.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/opaque.glsl"
#include "../../common/surface.glsl"
#include "../../common/triangle_hash.h"
#include "pixels.glsl"

layout(constant_id = kListConstantMedia) const bool kMedia = true;
layout(constant_id = kListConstantOneBand) const bool kOneBand = false;
layout(constant_id = kListConstantAlone) const bool kAlone = false;
layout(constant_id = kListConstantColoured) const bool kColoured = true;
layout(constant_id = kListConstantEveryTile) const bool kEveryTile = false;

uint64_t packWord(vec2 pair) { return packUint2x32(floatBitsToUint(pair)); }

SurfaceRecord makeRecord(SurfacePoint point) {
    SurfaceRecord record;
    if (isSolid(point)) {
        Gloss gloss = findGloss(point);
        record.radiance = gloss.radiance;
        record.loss = vec3(1.0 - gloss.rest);
    } else {
        ThinResponse response = findThinResponse(point);
        record.radiance = response.coverage * response.radiance;
        record.loss = response.coverage * (1.0 - response.transmission);
    }
    record.rank = triangleHash(push.step, triangle);
    record.distanceLo = point.t > 0.0 ? point.tLo : 0.0;
    return record;
}

void storeRecord(uint slot, uint index, SurfacePoint point) {
    SurfaceRecord record = makeRecord(point);
    if (kSolids) {
        uint face = !isSolid(point) ? kFaceThin : point.isFront ? kFaceFront : kFaceBack;
        SolidRecordArray(recordsOf(slot)).at[index] =
            SolidRecord(record, point.material.extinction, point.material.scattering, face);
    } else {
        RecordArray(recordsOf(slot)).at[index] = record;
    }
}

void store(uint slot, uint inside, SurfacePoint point) {
    uint index = atomicAdd(UintArray(push.surfaceCursors).at[slot * 64u + inside], 1u);
    uint at = slot * kTileOffsets + inside;
    uint end = UintArray(push.surfaceOffsets).at[at + 1u];
    if (index >= end) return;  // no room
    storeRecord(slot, index, point);
    uint entry = index;
    if (kMedia) entry = UintArray(push.offsets).at[at + 1u] - (end - index);
    entriesOf(slot).at[entry] =
        uvec2(distanceKey(max(point.t, 0.0)), kKindSurface << kKindShift | index);
}

void storeWords(uint slot, uint inside, SurfacePoint point) {
    SurfaceRecord record = makeRecord(point);
    uint words = kColoured ? kThinRecordWords : kGreyRecordWords;
    uint first =
        atomicAdd(UintArray(push.surfaceCursors).at[slot * 64u + inside], words * kTileSize);
    WordArray memory = WordArray(push.lists);
    memory.at[first] = packUint2x32(uvec2(record.rank, distanceKey(max(point.t, 0.0))));
    memory.at[first + kTileSize] = packWord(record.radiance.rg);
    memory.at[first + 2u * kTileSize] = packWord(vec2(record.radiance.b, record.loss.r));
    if (kColoured) memory.at[first + 3u * kTileSize] = packWord(record.loss.gb);
}

void main() {
    SurfacePoint point = findSurfacePoint();
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    bool isSeen = !kOpaque || isSolid(point) ||
                  point.t < opaqueDistanceAt(ivec2(pixel));
    uint slot, inside;
    if (!isSeen || !findPixel(pixel, kOneBand, kEveryTile, slot, inside)) return;
    if (kAlone)
        storeWords(slot, inside, point);
    else
        store(slot, inside, point);
}
