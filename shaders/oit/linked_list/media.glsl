// SPDX-License-Identifier: Apache-2.0
// Visits the media of a column of eight pixels: each invocation of count.comp and store.comp owns
// one column of a tile and all lists in it, so that no atomics are needed.
#ifndef BRUME_OIT_LINKED_LIST_MEDIA_GLSL
#define BRUME_OIT_LINKED_LIST_MEDIA_GLSL
#include "../../common/bindings.glsl"
#include "../../common/camera.glsl"
#include "../../common/intersect.glsl"
#include "pixels.glsl"

layout(local_size_x = 64) in;  // eight tiles
layout(constant_id = 0) const bool kSpheres = true;
layout(constant_id = 1) const bool kBoxes = true;
layout(constant_id = 2) const bool kSurfaces = true;
layout(binding = kBindingSpheres, scalar) readonly buffer Spheres { SphereData spheres[]; };
layout(binding = kBindingBoxes, scalar) readonly buffer Boxes { BoxData boxes[]; };
layout(binding = kBindingVolumes, scalar) readonly buffer Volumes { VolumeData volumes[]; };
layout(binding = kBindingOpaqueT) uniform sampler2D opaqueT;

const uint kRows = kTileSize;

Ray columnRays[kRows];
float columnLimits[kRows];  // media that begin behind this distance are not seen

// False outside the band. `column`: of the tile, and the first of its pixels.
bool beginColumn(out uint tile, out uint slot, out uint column) {
    uint thread = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u;
    column = thread % kTileSize;
    bool isInBand = findSlot(thread / kTileSize, slot, tile);
    uvec2 corner = tileCorner(tile) + uvec2(column, 0u);
    for (uint row = 0u; row < kRows; ++row) {
        uvec2 pixel = corner + uvec2(0u, row);
        bool inside = all(lessThan(pixel, frame.size));
        columnRays[row] = makeRay(vec2(pixel) + 0.5);
        columnLimits[row] = inside ? texelFetch(opaqueT, ivec2(pixel), 0).x : -1.0;
    }
    return isInBand;
}

// The part of list[first .. last) that this dispatch visits.
void sliceMedia(inout uint first, inout uint last) {
    first = min(first + push.step, last);
    last = min(first + kMediaPerSlice, last);
}

bool hitsSphere(SphereData sphere, uint row, out vec2 t) {
    return mayHitSphere(columnRays[row].origin, columnRays[row].direction, sphere.center,
                        sphere.radius, t) &&
           t.x < columnLimits[row];
}

bool hitsBox(BoxData box, VolumeData volume, uint row, out vec2 t) {
    return mayHitBox(volume.indexFromWorld * (columnRays[row].origin - box.corner),
                     volume.indexFromWorld * columnRays[row].direction, box.size, t) &&
           t.x < columnLimits[row];
}

#endif
