// SPDX-License-Identifier: Apache-2.0
// Pulls the vertices of a mesh. The plane of the triangle goes along, so that fragments find their
// distance by intersecting the ray with it instead of interpolating.
#version 460
#extension GL_GOOGLE_include_directive : require
#define BRUME_SURFACE_PASS
#include "bindings.glsl"
#include "camera.glsl"
#include "mesh.h"
#include "real.glsl"

layout(binding = kBindingVertices, scalar) readonly buffer Vertices { VertexData vertices[]; };
layout(binding = kBindingIndices, scalar) readonly buffer Indices { uint indices[]; };
layout(binding = kBindingMesh, scalar) uniform MeshBlock { MeshData mesh; };

layout(location = 0) out vec3 normal;
layout(location = 1) out vec2 uv;
layout(location = 2) flat out vec4 plane;  // unit outward normal, its dot product with a corner
layout(location = 3) flat out uint triangle;
layout(location = 4) flat out vec4 planeLo;  // what rounding has taken from it

Real3 relativePosition(uint corner) {
    VertexData vertex = vertices[mesh.firstVertex + indices[mesh.firstIndex + corner]];
    Real3 p = Real3(vertex.position);
    Real3 sum = makeReal(mesh.relativeFromObject[3], mesh.relativeFromObjectLo[3]);
    for (int axis = 0; axis < 3; ++axis)
        sum += p[axis] *
               makeReal(mesh.relativeFromObject[axis], mesh.relativeFromObjectLo[axis]);
    return sum;
}

void main() {
    triangle = gl_VertexIndex / 3;
    Real3 corners[3];
    for (uint i = 0u; i < 3u; ++i) corners[i] = relativePosition(triangle * 3u + i);
    Real3 across = cross(corners[1] - corners[0], corners[2] - corners[0]);
    Real area = length(across);
    Real3 unit = area > Real(0) ? across / area : Real3(0);
    Real distance = dot(unit, corners[0]);
    plane = vec4(vec3(unit), float(distance));
    planeLo = vec4(vec3(unit - Real3(plane.xyz)), findLo(distance));
    VertexData vertex = vertices[mesh.firstVertex + indices[mesh.firstIndex + gl_VertexIndex]];
    normal = mesh.normalFromObject * vertex.normal;
    uv = vertex.uv;
    gl_Position = clipFromRelative(vec3(corners[gl_VertexIndex % 3]));
}
