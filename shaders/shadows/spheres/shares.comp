// SPDX-License-Identifier: Apache-2.0
// The share of each light that arrives at the front of each sphere that is shadowed as a whole: at
// the point of its surface nearest to the light, or at the light where that is inside.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/lighting.glsl"
#include "../common/casters.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { SharesPush push; };
layout(buffer_reference, scalar) writeonly buffer Shares { vec3 at[]; };

vec3 frontOf(SphereData sphere, LightData light) {
    vec3 center = sphere.center + sphere.centerLo;
    if (light.type == kLightDirectional) return center - sphere.radius * light.direction;
    vec3 toLight = light.position - center;
    float distance = length(toLight);
    return center + toLight * (min(sphere.radius, distance) / max(distance, 1e-30));
}

void main() {
    uint i = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u;
    uint light = i % max(frame.lightCount, 1u);
    i /= max(frame.lightCount, 1u);
    if (i >= push.count) return;
    SphereData sphere = ShadowSpheres(push.spheres).at[i];
    if (sphere.shares == kNoShares || !(sphere.radius > 0.0)) return;
    LightData data = lights[light];
    vec3 share = transmittance(light, frontOf(sphere, data));
    Shares(push.shares).at[sphere.shares * frame.lightCount + light] = share;
}
