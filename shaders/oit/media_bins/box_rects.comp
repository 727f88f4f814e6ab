// SPDX-License-Identifier: Apache-2.0
// Finds the tiles that each brick or box touches; if asked for, copies them into sorted order.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/bindings.glsl"
#include "../../gpu/address.glsl"
#include "bins.h"
#include "rect.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kSorted = false;
layout(binding = kBindingBoxes, scalar) readonly buffer Boxes { BoxData boxes[]; };
layout(binding = kBindingVolumes, scalar) readonly buffer Volumes { VolumeData volumes[]; };
layout(binding = kBindingSortedBoxes, scalar) writeonly buffer Sorted { BoxData sorted[]; };
layout(push_constant, scalar) uniform Push { BinPush push; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    BoxData box = boxes[kSorted ? UintArray(push.values).at[i] : i];
    if (kSorted) sorted[i] = box;
    Uvec2Array(push.rects).at[i] = tileRect(boxBounds(box, volumes[box.volume]));
}
