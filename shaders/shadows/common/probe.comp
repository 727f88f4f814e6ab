// SPDX-License-Identifier: Apache-2.0
// Transmittance at given points, for tests and benchmarks: what a shader that lights them would
// see.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/lighting.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { ShadowPush push; };  // map: index of the light
layout(buffer_reference, scalar) buffer Points { vec3 at[]; };

void main() {
    uint i = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u;
    if (i >= push.count) return;
    Points(push.target).at[i] = transmittance(uint(push.map), Points(push.source).at[i]);
}
