// SPDX-License-Identifier: Apache-2.0
// Triangle meshes and their materials on the GPU; C++ and GLSL.
#ifndef BRUME_SHADERS_COMMON_MESH_H
#define BRUME_SHADERS_COMMON_MESH_H
#include "shared.h"

BRUME_STRUCTS_BEGIN

struct VertexData {
    vec3 position;  // object space
    vec3 normal;    // unit
    vec2 uv;
};

struct MeshData {
    mat4x3 relativeFromObject, relativeFromObjectLo;  // to metres relative to the camera
    mat3 normalFromObject;
    uint firstVertex;
    uint firstIndex;
};

BRUME_CONST uint kMaterialOpaque = 0u;
BRUME_CONST uint kMaterialThin = 1u;
BRUME_CONST uint kMaterialSolid = 2u;

struct MaterialData {
    vec3 albedo;  // opaque
    uint type;
    vec3 emission;
    float coverage;  // thin
    vec3 transmission;
    float alphaCutoff;  // fragments with less alpha do not exist; < 0: all do
    vec3 reflected;     // thin
    vec3 extinction;    // solid, 1/m
    vec3 scattering;    // solid, 1/m
    float collimation;  // thin: 1 keeps the background sharp
    float ior;          // thin and solid
    float roughness;    // of glass that mirrors; < 0: it does not
    vec3 depth;         // thin: -ln(1 - coverage (1 - transmission)), at most kMaxDepth
};

// An optical depth behind which nothing is seen; sums of it stay finite.
BRUME_CONST float kMaxDepth = 80.0f;

// Own bindings of every pass that draws meshes.
BRUME_CONST uint kBindingVertices = 8u;
BRUME_CONST uint kBindingIndices = 9u;
BRUME_CONST uint kBindingMesh = 10u;      // MeshData of the draw, a uniform block
BRUME_CONST uint kBindingMaterial = 11u;  // MaterialData of the draw, a uniform block
BRUME_CONST uint kBindingColorTexture = 12u;
BRUME_CONST uint kBindingEmissionTexture = 13u;
BRUME_CONST uint kBindingEnvironment = 15u;
BRUME_CONST uint kBindingTriangles = 14u;  // uint[pixels]: sums of triangleHash()

// Specialization constant of everything that shades surfaces: does any of them mirror?
BRUME_CONST uint kConstantGlossy = 65u;
// Has any of them a texture?
BRUME_CONST uint kConstantTextured = 69u;

// Is any of them a solid?
BRUME_CONST uint kConstantSolids = 73u;

// Bytes from one MeshData or MaterialData to the next: uniform blocks may start at multiples of it
// on every device.
BRUME_CONST uint kUniformStride = 256u;

struct MeshPush {
    uint meshIndex;
};

BRUME_STRUCTS_END

#ifdef __cplusplus
static_assert(sizeof(brume::shader::VertexData) == 32);
static_assert(sizeof(brume::shader::MeshData) == 140);
static_assert(offsetof(brume::shader::MeshData, firstVertex) == 132);
static_assert(sizeof(brume::shader::MaterialData) == 108);
#endif
#endif
