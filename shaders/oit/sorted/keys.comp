// SPDX-License-Identifier: Apache-2.0
// Sort key of each medium: far to near by the distance of its centre.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/bindings.glsl"
#include "../../gpu/address.glsl"
#include "../layers/layers.h"

layout(local_size_x = 64) in;
layout(binding = kBindingSpheres, scalar) readonly buffer Spheres { SphereData spheres[]; };
layout(binding = kBindingBoxes, scalar) readonly buffer Boxes { BoxData boxes[]; };
layout(binding = kBindingVolumes, scalar) readonly buffer Volumes { VolumeData volumes[]; };
layout(push_constant, scalar) uniform Push { LayerPush push; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    vec3 center;
    if (i < frame.sphereCount) {
        center = spheres[i].center;
    } else {
        BoxData box = boxes[i - frame.sphereCount];
        center = box.corner + volumes[box.volume].worldFromIndex * (0.5 * box.size);
    }
    float depth = hasParallelRays() ? max(dot(center, frame.forward), 0.0) : length(center);
    UintArray(push.keys).at[i] = ~floatBitsToUint(depth);
    UintArray(push.order).at[i] = i;
}
