// SPDX-License-Identifier: Apache-2.0
// target[i] = source[i] + amount.
#version 460
layout(local_size_x = 64) in;
layout(binding = 0) readonly buffer Source { uint source[]; };
layout(binding = 1) writeonly buffer Target { uint target[]; };
layout(push_constant) uniform Push { uint amount; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < target.length()) target[i] = source[i] + amount;
}
