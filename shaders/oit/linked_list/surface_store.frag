// SPDX-License-Identifier: Apache-2.0
// Stores the fragments of thin and solid surfaces: a record each, and an entry behind the media of
// the pixel, in the order of arrival.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/surface.glsl"
#include "../../common/triangle_hash.h"
#include "pixels.glsl"

layout(binding = kBindingOpaqueT) uniform sampler2D opaqueT;

SurfaceRecord makeRecord(SurfacePoint point) {
    SurfaceRecord record;
    record.distanceLo = point.t > 0.0 ? point.tLo : 0.0;
    record.rank = triangleHash(push.step, triangle);
    if (point.material.type == kMaterialSolid) {
        Gloss gloss = findGloss(point);
        record.radiance = gloss.radiance;
        record.coverage = 1.0 - gloss.rest;
        record.transmission = point.material.extinction;
        record.scattering = point.material.scattering;
        record.face = point.isFront ? kFaceFront : kFaceBack;
    } else {
        ThinResponse response = findThinResponse(point);
        record.radiance = response.radiance;
        record.coverage = response.coverage;
        record.transmission = response.transmission;
        record.scattering = vec3(0);
        record.face = kFaceThin;
    }
    return record;
}

void main() {
    SurfacePoint point = findSurfacePoint();
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    bool isSeen =
        point.material.type == kMaterialSolid || point.t < texelFetch(opaqueT, ivec2(pixel), 0).x;
    uint slot, inside;
    if (!isSeen || !findPixel(pixel, slot, inside)) return;
    uint arrival = atomicAdd(UintArray(push.surfaceCursors).at[slot * 64u + inside], 1u);
    uint index = slot * kTileOffsets + inside;
    uint recordIndex = UintArray(push.surfaceOffsets).at[index] + arrival;
    uint end = UintArray(push.surfaceOffsets).at[index + 1u];
    if (recordIndex >= end) return;  // no room
    uint entry = UintArray(push.offsets).at[index + 1u] - (end - recordIndex);
    recordsOf(slot).at[recordIndex] = makeRecord(point);
    entriesOf(slot).at[entry] =
        uvec2(distanceKey(max(point.t, 0.0)), kKindSurface << kKindShift | recordIndex);
}
