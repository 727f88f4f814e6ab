// SPDX-License-Identifier: Apache-2.0
// Copies the spheres into sorted order and finds the tiles that each touches.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/bindings.glsl"
#include "../../gpu/address.glsl"
#include "bins.h"
#include "rect.glsl"

layout(local_size_x = 64) in;
layout(binding = kBindingSpheres, scalar) readonly buffer Spheres { SphereData spheres[]; };
layout(binding = kBindingSortedSpheres, scalar) writeonly buffer Sorted { SphereData sorted[]; };
layout(push_constant, scalar) uniform Push { BinPush push; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    SphereData sphere = spheres[UintArray(push.values).at[i]];
    sorted[i] = sphere;
    MediumData medium = media[sphere.medium];
    bool isSeen = any(greaterThan(medium.extinction + medium.emission, vec3(0)));
    bool valid = sphere.radius > 0.0 && sphere.density > 0.0 && isSeen;
    Uvec2Array(push.rects).at[i] =
        valid ? tileRect(sphereBounds(sphere.center, sphere.radius)) : kNoRect;
}
