// SPDX-License-Identifier: Apache-2.0
// What every pass of a frame may read: camera, counts, lights, media, volumes; C++ and GLSL.
// All positions are relative to the camera position, axes as in the world, metres. A member ...Lo
// is what rounding to float has taken from the member before it: real.glsl adds both.
#ifndef BRUME_SHADERS_COMMON_FRAME_H
#define BRUME_SHADERS_COMMON_FRAME_H
#include "shared.h"

BRUME_STRUCTS_BEGIN

struct FrameData {
    vec3 right;
    float extentX;  // half width of the image plane (perspective: at distance 1; orthographic: m)
    vec3 up;
    float extentY;
    float centerX;  // middle of the image on that plane, 0 where it is symmetric
    float centerY;
    vec3 forward, forwardLo;
    // What is at x, y in pixels from the top-left corner is at corner + x pixelRight + y pixelDown on
    // that plane: towards it goes the ray of a perspective camera, there begins that of another.
    vec3 corner, cornerLo;
    vec3 pixelRight, pixelRightLo;
    vec3 pixelDown, pixelDownLo;
    float near;    // m, nearest view depth of triangles
    vec3 ambient;  // radiance of the ambient lights together
    uint orthographic;
    vec3 background;  // radiance, where there is no environment
    float environmentScale;
    uvec2 size;  // pixels
    uvec2 tiles;
    uvec2 environmentSize;  // texels; 0: none
    uint sphereCount;
    uint boxCount;
    uint lightCount;  // without the ambient ones
    uint mediumCount;
    float far;             // m; depth range of an orthographic camera
    uint64_t brickValues;  // address of float[]
    uint64_t lightShares;  // address of vec3[]: of spheres shadowed as a whole, lightCount for each
};

BRUME_CONST uint kLightDirectional = 0u;
BRUME_CONST uint kLightPoint = 1u;
BRUME_CONST uint kLightSpot = 2u;

struct LightData {
    vec3 color;  // irradiance (directional), intensity (point, spot)
    uint type;
    vec3 position;
    float radius;    // m; E = I / max(d^2, radius^2)
    vec3 positionLo;  // what rounding has taken from the position
    vec3 direction;  // unit, in which the light travels
    float cosInner;
    float cosOuter;
    uint64_t
        shadow;  // address of its ShadowMap (shadows/common/maps.h); 0: shines through everything
};

BRUME_CONST uint kPhaseIsotropic = 0u;
BRUME_CONST uint kPhaseRayleigh = 1u;
BRUME_CONST uint kPhaseHenyeyGreenstein = 2u;

struct MediumData {
    vec3 extinction;  // 1/m per unit density
    uint phase;
    vec3 albedo;
    float g;
    vec3 emission;  // radiance per metre per unit density
};

struct VolumeData {
    mat3 indexFromWorld;  // linear part: index steps per metre
    mat3 worldFromIndex;
    uint medium;
};

BRUME_CONST uint kBoxBrick = 0u;  // trilinear inside 8^3 cells
BRUME_CONST uint kBoxSoft = 1u;   // constant, ramps of one index step at its borders
BRUME_CONST uint kBoxHard = 2u;   // constant

// A brick or box of a volume. Local coordinates: index steps from its low corner, in [0, size].
struct BoxData {
    vec3 corner, cornerLo;  // the low corner, m relative to the camera
    uint volume;
    vec3 size;  // index steps
    uint kind;
    uint valueOffset;  // brick: of its 9^3 values
    float value;       // soft, hard: the density; brick: the largest
};

BRUME_CONST uint kTileSize = 8u;  // pixels per edge of a screen tile

BRUME_STRUCTS_END

#ifdef __cplusplus
static_assert(sizeof(brume::shader::FrameData) == 232);
static_assert(offsetof(brume::shader::FrameData, size) == 172);
static_assert(sizeof(brume::shader::LightData) == 72);
static_assert(sizeof(brume::shader::MediumData) == 44);
static_assert(sizeof(brume::shader::VolumeData) == 76);
static_assert(sizeof(brume::shader::BoxData) == 52);
#endif
#endif
