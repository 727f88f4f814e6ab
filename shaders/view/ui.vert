// SPDX-License-Identifier: Apache-2.0
// Triangles of the user interface.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "ui.h"

layout(push_constant, scalar) uniform Push { UiPush push; };
layout(binding = kBindingUiVertices, scalar) readonly buffer Vertices { UiVertex vertices[]; };
layout(location = 0) out vec2 uv;
layout(location = 1) out vec4 color;

void main() {
    UiVertex vertex = vertices[gl_VertexIndex];
    uv = vertex.uv;
    color = unpackUnorm4x8(vertex.color);
    gl_Position = vec4(vertex.position * push.scale + push.offset, 0.0, 1.0);
}
