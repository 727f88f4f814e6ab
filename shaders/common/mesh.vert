// SPDX-License-Identifier: Apache-2.0
// Pulls the vertices of a mesh. The plane of the triangle goes along, so that fragments find their
// distance by intersecting the ray with it instead of interpolating.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bindings.glsl"
#include "camera.glsl"
#include "mesh.h"

layout(binding = kBindingVertices, scalar) readonly buffer Vertices { VertexData vertices[]; };
layout(binding = kBindingIndices, scalar) readonly buffer Indices { uint indices[]; };
layout(binding = kBindingMesh, scalar) uniform MeshBlock { MeshData mesh; };

layout(location = 0) out vec3 normal;
layout(location = 1) out vec2 uv;
layout(location = 2) flat out vec4 plane;  // unit outward normal, its dot product with a corner
layout(location = 3) flat out uint triangle;

vec3 relativePosition(uint corner) {
    VertexData vertex = vertices[mesh.firstVertex + indices[mesh.firstIndex + corner]];
    return mesh.relativeFromObject * vec4(vertex.position, 1.0);
}

void main() {
    triangle = gl_VertexIndex / 3;
    vec3 corners[3];
    for (uint i = 0u; i < 3u; ++i) corners[i] = relativePosition(triangle * 3u + i);
    vec3 across = cross(corners[1] - corners[0], corners[2] - corners[0]);
    float area = length(across);
    plane.xyz = area > 0.0 ? across / area : vec3(0);
    plane.w = dot(plane.xyz, corners[0]);
    VertexData vertex = vertices[mesh.firstVertex + indices[mesh.firstIndex + gl_VertexIndex]];
    normal = mesh.normalFromObject * vertex.normal;
    uv = vertex.uv;
    gl_Position = clipFromRelative(corners[gl_VertexIndex % 3]);
}
