// SPDX-License-Identifier: Apache-2.0
// Sort key of each sphere: the distance at which it begins. Spheres that are not there go last.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/bindings.glsl"
#include "../../gpu/address.glsl"
#include "bins.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kByIdentity = false;
layout(binding = kBindingSpheres, scalar) readonly buffer Spheres { SphereData spheres[]; };
layout(push_constant, scalar) uniform Push { BinPush push; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    // After a sort by identity the distances are read in that order; a stable sort then leaves
    // equal distances in the order of identity, whatever the order of submission.
    uint source = kByIdentity ? i : UintArray(push.values).at[i];
    SphereData sphere = spheres[source];
    float distance =
        hasParallelRays() ? dot(sphere.center, frame.forward) : length(sphere.center);
    bool valid = sphere.radius > 0.0 && sphere.density > 0.0;
    uint key = valid ? floatBitsToUint(max(distance - sphere.radius, 0.0)) : 0xffffffffu;
    UintArray(push.keys).at[i] = kByIdentity ? sphere.id : key;
    if (kByIdentity) UintArray(push.values).at[i] = i;
}
