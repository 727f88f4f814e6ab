// SPDX-License-Identifier: Apache-2.0
// Samples a 3D texture at given points.
#version 460
layout(local_size_x = 8) in;
layout(binding = 0) uniform sampler3D source;
layout(binding = 1) readonly buffer Points { vec4 points[]; };
layout(binding = 2) writeonly buffer Values { vec4 values[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < points.length()) values[i] = textureLod(source, points[i].xyz, 0.0);
}
