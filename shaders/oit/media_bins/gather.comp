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

// All such spheres together change a pixel by less than this share of the light there.
const float kNegligibleDepth = 1e-9;

// Whether a sphere's optical depth is too small to be seen. What glows is seen whatever its depth.
bool isNegligible(SphereData sphere) {
    MediumData medium = media[sphere.medium];
    if (any(greaterThan(medium.emission, vec3(0)))) return false;
    vec3 depth = 2.0 * sphere.radius * sphere.density * medium.extinction * max(sphere.tint, 1.0);
    return all(lessThanEqual(depth * float(push.count), vec3(kNegligibleDepth)));
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    SphereData sphere = spheres[UintArray(push.values).at[i]];
    sorted[i] = sphere;
    bool valid = sphere.radius > 0.0 && sphere.density > 0.0 && !isNegligible(sphere);
    Uvec2Array(push.rects).at[i] =
        valid ? tileRect(sphereBounds(sphere.center, sphere.radius)) : kNoRect;
}
