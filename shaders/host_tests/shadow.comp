// SPDX-License-Identifier: Apache-2.0
// A host's shader that asks for shadows at some points.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "../host/brume_shadow.glsl"

layout(local_size_x = 8) in;
layout(binding = 0) readonly buffer Points { vec4 points[]; };
layout(binding = 1) writeonly buffer Results { vec4 results[]; };
layout(push_constant) uniform Push { uint64_t shadow; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    results[i] = vec4(brumeTransmittance(shadow, points[i].xyz), 1.0);
}
