// SPDX-License-Identifier: Apache-2.0
// A light's shadow map: its geometry, its casters and what its store has made of them; C++ and
// GLSL.
#ifndef BRUME_SHADERS_SHADOWS_COMMON_MAPS_H
#define BRUME_SHADERS_SHADOWS_COMMON_MAPS_H
#include "../../common/shared.h"

BRUME_STRUCTS_BEGIN

// Bits of the specialization constant kShadowStores: which stores the lights of a scene use.
BRUME_CONST uint kStoreOpaque = 1u;
BRUME_CONST uint kStoreExact = 2u;
BRUME_CONST uint kStoreTotal = 4u;
BRUME_CONST uint kStoreVisibility = 8u;
BRUME_CONST uint kStoreStochastic = 16u;
BRUME_CONST uint kStoreStochasticVsm = 32u;
BRUME_CONST uint kStoreFourier = 64u;

// The id of that constant in every shader that lights something. Its default is all stores: right
// for any scene, and slower than the constant that lightingConstants() of the host gives.
BRUME_CONST uint kConstantShadowStores = 64u;

// The id of the constant kShadowing, bits: how media that scatter are shadowed; none where there
// are no stores. Default: both.
BRUME_CONST uint kConstantShadowing = 66u;
BRUME_CONST uint kShadowingWhole = 1u;    // some spheres as a whole
BRUME_CONST uint kShadowingSampled = 2u;  // some media at each place

BRUME_CONST uint kMapTileSize = 8u;  // texels per edge of a tile; casters are binned to tiles

// Distances are measured along the light's rays: from the plane through `origin` (directional) or
// from the light. Texel (x, y) of face f is number ((f * resolution) + y) * resolution + x.
struct ShadowMap {
    vec3 origin;  // m relative to the camera: of the map's plane, or the light
    uint store;
    vec3 right;
    uint isDirectional;
    vec3 up;
    float extent;  // half the width of a face: m (directional), else at distance 1
    vec3 forward;
    uint resolution;     // texels per edge of a face, a multiple of kMapTileSize
    uint faceCount;      // 1, or 6: a cube
    uint channels;       // 1 or 3
    uint count;          // visibility: nodes; stochastic: samples per texel; fourier: coefficients
    uint filterRadius;   // texels: tent over 2 r + 1
    float begin;         // no caster is nearer to the light,
    float end;           // none farther
    float stepLength;    // m within which light on media is taken as smooth
    uint64_t opaque;     // address of the ShadowMap of the opaque casters; 0: there is none
    uint64_t texels;     // the store's own
    uint64_t totals;     // float[texels * channels], or 0
    uint64_t noise;      // float[64 * 64]: blue noise in (0, 1)
    uint64_t spheres;    // SphereData[]
    uint64_t boxes;      // BoxData[]
    uint64_t volumes;    // VolumeData[]
    uint64_t triangles;  // ShadowTriangle[]
    uint64_t materials;  // ShadowMaterial[]
    uint64_t sphereOffsets, spherePairs;  // uint[tiles + 1], uint[]: the casters of each tile
    uint64_t boxOffsets, boxPairs;
    uint64_t triangleOffsets, trianglePairs;
    uint isIndependent;  // stochastic: samples of a texel are not stratified
    uint hasCaustics;    // glass gathers its light where it meets the glass at right angles
};

// A triangle of any mesh, in metres relative to the camera.
struct ShadowTriangle {
    vec3 a, b, c;
    vec2 uvA, uvB, uvC;
    uint normalA, normalB, normalC;  // packNormal()
    uint material;
    uint id;
};

struct ShadowMaterial {
    vec3 transmission;  // thin
    uint type;          // kMaterialOpaque, kMaterialThin, kMaterialSolid
    vec3 extinction;    // solid, 1/m
    float coverage;
    float alphaCutoff;  // < 0: none
    float ior;
    uvec2 textureSize;  // 0: none
    uint64_t texture;   // vec4[]
};

BRUME_CONST uint kNoiseSize = 64u;

// Media are cut into pieces of about this optical depth; chosen by us, a test of the visibility
// store notices a coarser one.
BRUME_CONST float kPieceDepth = 0.02f;
// Ids of what one random number decides about. Spheres and triangles have their own below and above;
// bricks of the first volumes share that of their volume, whose light then ends once.
BRUME_CONST uint kBoxIds = 0x40000000u;
BRUME_CONST uint kVolumeIds = 0x7fffff00u;
BRUME_CONST uint kSharedVolumes = 4u;
BRUME_CONST uint kTriangleIds = 0x80000000u;
BRUME_CONST uint kSolidIds = 0xc0000000u;

BRUME_CONST uint kMaxSolidHits = 16u;  // front and back faces of solids along one ray

struct ShadowPush {
    uint64_t map;  // ShadowMap
    uint64_t target;
    uint64_t source;
    uint count;
};

struct SharesPush {
    uint64_t spheres;  // SphereData[count]
    uint64_t shares;   // vec3[]
    uint count;
};

struct ShadowBinPush {
    uint64_t map;
    uint64_t keys;     // uint[]: order: sort keys of the casters; scatter: tiles of the pairs
    uint64_t values;   // uint[]: casters in the order of distance; scatter: of the pairs
    uint64_t order;    // uint[count]
    uint64_t offsets;  // uint[count + 1]: pairs of the casters before; starts: uint[tiles + 1]
    uint count;        // of casters; starts: of pairs
    uint first;        // index of the first caster
    uint tileCount;
    uint capacity;     // pairs that there is room for; more are left out
};

BRUME_CONST uint kCasterSphere = 0u;
BRUME_CONST uint kCasterBox = 1u;
BRUME_CONST uint kCasterTriangle = 2u;

BRUME_STRUCTS_END

#ifdef __cplusplus
static_assert(sizeof(brume::shader::ShadowTriangle) == 80);
static_assert(sizeof(brume::shader::ShadowMaterial) == 56);
static_assert(offsetof(brume::shader::ShadowMap, opaque) == 96);
static_assert(sizeof(brume::shader::ShadowBinPush) == 56);
#endif
#endif
