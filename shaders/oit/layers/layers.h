// SPDX-License-Identifier: Apache-2.0
// Media, thin surfaces and solids rastered as layers; C++ and GLSL.
#ifndef BRUME_SHADERS_OIT_LAYERS_H
#define BRUME_SHADERS_OIT_LAYERS_H
#include "../../common/mesh.h"

BRUME_STRUCTS_BEGIN

struct LayerPush {
    uint64_t keys;   // sort: uint[count]
    uint64_t order;  // uint[count], media in drawing order; 0: as they come
    uint64_t data;   // a method's own buffer
    uint count;      // sphereCount + boxCount
    uint mesh;       // surfaces: which mesh is drawn
    uint step;       // of a method that draws its layers several times
};

// Specialization constants of all layer shaders; a method's own begin at kLayerConstantOwn.
BRUME_CONST uint kLayerConstantBoxes = 0u;     // bool: there are boxes
BRUME_CONST uint kLayerConstantVarying = 1u;   // bool: densities vary along a ray
BRUME_CONST uint kLayerConstantColoured = 2u;  // bool: transmittance differs between channels
BRUME_CONST uint kLayerConstantScale = 3u;     // pixels per edge of a texel of the targets
BRUME_CONST uint kLayerConstantOwn = 4u;

// What solids leave in a pixel, summed over all faces along the ray.
BRUME_CONST uint kBindingSolidDepth = 14u;   // RGBA32F: optical depth; faces entered less left
BRUME_CONST uint kBindingSolidSource = 15u;  // RGBA32F: scattering coefficient times length
BRUME_CONST uint kBindingSolidRange = 16u;   // RG32F: -distance of the nearest face, of the farthest
BRUME_CONST uint kBindingLayerOwn = 17u;     // a method's own bindings begin here

BRUME_STRUCTS_END

#ifdef __cplusplus
static_assert(offsetof(brume::shader::LayerPush, step) == 32);
#endif
#endif
