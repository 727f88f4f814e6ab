// SPDX-License-Identifier: Apache-2.0
// Finds tiles at some pixel of which a brick or box begins before those ahead of it in the tile's
// list have ended.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "media.glsl"

layout(binding = kBindingBoxes, scalar) readonly buffer Boxes { BoxData boxes[]; };
layout(binding = kBindingVolumes, scalar) readonly buffer Volumes { VolumeData volumes[]; };

#ifdef BRUME_FLOAT64
const Real kMargin = Real(1e-7);  // of the distance: corners are stored finer than that
#else
const Real kMargin = Real(2e-6);
#endif

void main() {
    uint tile;
    uvec2 pixel;
    if (!beginPixel(tile, pixel)) return;
    RealRay ray = makeTileRay(pixel);
    Real limit = Real(texelFetch(opaqueT, ivec2(pixel), 0).x);
    uint k = UintArray(push.boxOffsets).at[tile];
    uint last = min(UintArray(push.boxOffsets).at[tile + 1u], k + kTileLongestList);
    Real reach = Real(0);
    bool overlaps = false;
    for (; k < last; ++k) {
        BoxData box = boxes[UintArray(push.boxPairs).at[k]];
        Real2 ends = boxChord(ray, box, volumes[box.volume]);
        ends.y = min(ends.y, limit);
        bool isMet = ends.y > ends.x;
        overlaps = overlaps || (isMet && ends.x < reach * (Real(1) - kMargin));
        reach = isMet ? max(reach, ends.y) : reach;
    }
    if (overlaps) atomicMax(UintArray(push.classes).at[tile], kClassLists);
}
