// SPDX-License-Identifier: Apache-2.0
// Sort keys of the casters: their ids, or where along the light they begin.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "caster.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 1) const bool kByIdentity = false;

float nearestDistance(ShadowMap map, Caster caster) {
    float nearest = 3.0e38;
    for (uint c = 0u; c < caster.cornerCount; ++c)
        nearest =
            min(nearest, map.isDirectional != 0u ? caster.corners[c].z : length(caster.corners[c]));
    return max(nearest - caster.radius - (map.isDirectional != 0u ? map.begin : 0.0), 0.0);
}

void main() {
    uint i = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u;
    if (i >= push.count) return;
    ShadowMap map = ShadowMapRef(push.map).map;
    if (kByIdentity) {
        UintArray(push.keys).at[i] =
            kCaster == kCasterSphere ? ShadowSpheres(map.spheres).at[i].id : i;
        UintArray(push.values).at[i] = push.first + i;
    } else {
        // A stable sort leaves equal distances in the order of identity.
        Caster caster = loadCaster(map, UintArray(push.values).at[i]);
        UintArray(push.keys).at[i] = floatBitsToUint(nearestDistance(map, caster));
    }
}
