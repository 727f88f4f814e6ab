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
        record.radiance = vec3(0);
        record.coverage = 0.0;
        record.transmission = point.material.extinction;
        record.scattering = point.material.scattering;
        record.face = point.isFront ? kFaceFront : kFaceBack;
    } else {
        record.radiance = sentRadiance(point, point.material.reflected);
        record.coverage = point.material.coverage * point.color.a;
        record.transmission = point.material.transmission * point.color.rgb;
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
    if (!isSeen || !isInBand(pixel)) return;
    uint index = pixelIndex(pixel);
    uint arrival = atomicAdd(UintArray(push.surfaceCursors).at[index], 1u);
    uint recordIndex = UintArray(push.surfaceOffsets).at[index] + arrival;
    uint behind = UintArray(push.surfaceOffsets).at[index + 1u] - recordIndex;
    uint slot = UintArray(push.offsets).at[index + 1u] - behind;
    RecordArray(push.records).at[recordIndex] = makeRecord(point);
    Uvec2Array(push.entries).at[slot] =
        uvec2(distanceKey(max(point.t, 0.0)), kKindSurface << kKindShift | recordIndex);
}
