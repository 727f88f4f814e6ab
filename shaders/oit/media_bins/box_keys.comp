// SPDX-License-Identifier: Apache-2.0
// Sort key of each brick or box: the distance from the eye to its nearest point; of parallel rays,
// the distance of its middle.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/bindings.glsl"
#include "../../gpu/address.glsl"
#include "bins.h"

layout(local_size_x = 64) in;
layout(binding = kBindingBoxes, scalar) readonly buffer Boxes { BoxData boxes[]; };
layout(binding = kBindingVolumes, scalar) readonly buffer Volumes { VolumeData volumes[]; };
layout(push_constant, scalar) uniform Push { BinPush push; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    BoxData box = boxes[i];
    VolumeData volume = volumes[box.volume];
    vec3 eye = volume.indexFromWorld * -box.corner;
    vec3 nearest = volume.worldFromIndex * (clamp(eye, vec3(0), box.size) - eye);
    vec3 middle = box.corner + volume.worldFromIndex * (0.5 * box.size);
    // Before the eye of parallel rays the distance is negative; keys sort like it.
    float distance = hasParallelRays() ? dot(middle, frame.forward) : length(nearest);
    uint key = floatBitsToUint(distance);
    UintArray(push.keys).at[i] = (key & 0x80000000u) != 0u ? ~key : key | 0x80000000u;
    UintArray(push.values).at[i] = i;
}
