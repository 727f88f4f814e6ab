// SPDX-License-Identifier: Apache-2.0
// One triangle over the whole target at a given depth.
#version 460
layout(push_constant) uniform Push {
    vec4 color;
    float depth;
};
void main() {
    vec2 corner = vec2((gl_VertexIndex << 1) & 2, gl_VertexIndex & 2);
    gl_Position = vec4(corner * 2.0 - 1.0, depth, 1.0);
}
