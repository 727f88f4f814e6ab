// SPDX-License-Identifier: Apache-2.0
// Counts fragments per pixel, with no attachment.
#version 460
layout(push_constant) uniform Push {
    vec4 color;
    float depth;
};
layout(binding = 0) buffer Counts { uint counts[]; };
layout(constant_id = 0) const uint kWidth = 1;
void main() { atomicAdd(counts[uint(gl_FragCoord.y) * kWidth + uint(gl_FragCoord.x)], 1u); }
