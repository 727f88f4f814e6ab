#version 460
// SPDX-License-Identifier: Apache-2.0
// A plain copy, one vec4 per invocation: what moving bytes costs a compute shader on this device.
#extension GL_GOOGLE_include_directive : require
#include "../common/shared.h"

layout(local_size_x_id = 0) in;
layout(set = 0, binding = 0, scalar) readonly buffer Source { vec4 source[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Target { vec4 target[]; };
layout(push_constant, scalar) uniform Push { uint count; };

void main() {
    uint i = gl_GlobalInvocationID.x +
             gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
    if (i < count) target[i] = source[i];
}
