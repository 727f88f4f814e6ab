// SPDX-License-Identifier: Apache-2.0
// Finds the tiles that each brick or box touches.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/bindings.glsl"
#include "../../gpu/address.glsl"
#include "bins.h"
#include "rect.glsl"

layout(local_size_x = 64) in;
layout(binding = kBindingBoxes, scalar) readonly buffer Boxes { BoxData boxes[]; };
layout(binding = kBindingVolumes, scalar) readonly buffer Volumes { VolumeData volumes[]; };
layout(push_constant, scalar) uniform Push { BinPush push; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    BoxData box = boxes[i];
    Uvec2Array(push.rects).at[i] = tileRect(boxBounds(box, volumes[box.volume]));
}
