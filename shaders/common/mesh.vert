// SPDX-License-Identifier: Apache-2.0
// Pulls the vertices of a mesh. The plane of the triangle goes along, so that fragments find their
// distance by intersecting the ray with it instead of interpolating, and their texture coordinates
// from where that is: a rasteriser's are off by thousandths of a texel, which edges in a texture
// show.
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

layout(constant_id = kConstantTextured) const bool kTextured = true;

layout(location = 0) out vec3 normal;
layout(location = 1) flat out uint triangle;
layout(location = 2) flat out vec4 plane;  // unit outward normal, its dot product with a corner
layout(location = 3) flat out vec4 planeLo;  // what rounding has taken from it
// Each texture coordinate at a place relative to the camera: dot(xyz, place) + w.
layout(location = 4) flat out vec4 textureU;
layout(location = 5) flat out vec4 textureULo;
layout(location = 6) flat out vec4 textureV;
layout(location = 7) flat out vec4 textureVLo;

VertexData vertexAt(uint corner) {
    return vertices[mesh.firstVertex + indices[mesh.firstIndex + corner]];
}

Real3 relativePosition(uint corner) {
    VertexData vertex = vertexAt(corner);
    Real3 p = Real3(vertex.position);
    Real3 sum = makeReal(mesh.relativeFromObject[3], mesh.relativeFromObjectLo[3]);
    for (int axis = 0; axis < 3; ++axis)
        sum += p[axis] *
               makeReal(mesh.relativeFromObject[axis], mesh.relativeFromObjectLo[axis]);
    return sum;
}

Real3 corners[3];

// Finds the linear function that has these values at the corners; `perEdge` are the gradients of
// what is 1 at the second or third corner and 0 at the others.
void findLinear(vec3 values, Real3 perEdge[2], out vec4 function, out vec4 functionLo) {
    Real3 gradient = perEdge[0] * Real(values.y - values.x) + perEdge[1] * Real(values.z - values.x);
    Real offset = Real(values.x) - dot(gradient, corners[0]);
    function = vec4(vec3(gradient), float(offset));
    functionLo = vec4(vec3(gradient - Real3(function.xyz)), findLo(offset));
}

void findTextureCoordinates(Real3 unit, Real area) {
    vec2 uvs[3];
    for (uint i = 0u; i < 3u; ++i) uvs[i] = vertexAt(triangle * 3u + i).uv;
    Real3 perEdge[2] = {cross(corners[2] - corners[0], unit) / area,
                        cross(unit, corners[1] - corners[0]) / area};
    findLinear(vec3(uvs[0].x, uvs[1].x, uvs[2].x), perEdge, textureU, textureULo);
    findLinear(vec3(uvs[0].y, uvs[1].y, uvs[2].y), perEdge, textureV, textureVLo);
}

void main() {
    triangle = gl_VertexIndex / 3;
    for (uint i = 0u; i < 3u; ++i) corners[i] = relativePosition(triangle * 3u + i);
    Real3 across = cross(corners[1] - corners[0], corners[2] - corners[0]);
    Real area = length(across);
    Real3 unit = area > Real(0) ? across / area : Real3(0);
    Real distance = dot(unit, corners[0]);
    plane = vec4(vec3(unit), float(distance));
    planeLo = vec4(vec3(unit - Real3(plane.xyz)), findLo(distance));
    normal = mesh.normalFromObject * vertexAt(gl_VertexIndex).normal;
    textureU = textureULo = textureV = textureVLo = vec4(0);
    if (kTextured && area > Real(0)) findTextureCoordinates(unit, area);
    gl_Position = clipFromRelative(vec3(corners[gl_VertexIndex % 3]));
}
