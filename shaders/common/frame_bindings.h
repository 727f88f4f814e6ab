// SPDX-License-Identifier: Apache-2.0
// Descriptor bindings shared by all passes; a technique's own start at kBindingOwn. C++ and GLSL.
#ifndef BRUME_SHADERS_COMMON_FRAME_BINDINGS_H
#define BRUME_SHADERS_COMMON_FRAME_BINDINGS_H
#include "shared.h"

BRUME_STRUCTS_BEGIN

BRUME_CONST uint kBindingFrame =
    0u;  // FrameData; a uniform block only in passes that draw meshes: Mesa 22 recompiles loops
         // whose length comes from such a block
BRUME_CONST uint kBindingLights = 1u;       // LightData[]
BRUME_CONST uint kBindingMedia = 2u;        // MediumData[]
BRUME_CONST uint kBindingSpheres = 3u;      // SphereData[]
BRUME_CONST uint kBindingBoxes = 4u;        // BoxData[]
BRUME_CONST uint kBindingVolumes = 5u;      // VolumeData[]
BRUME_CONST uint kBindingOpaqueT = 6u;      // R32F: distance of the opaque surface along the ray
BRUME_CONST uint kBindingOpaqueColor = 7u;  // RGBA32F: radiance of what lies behind everything
BRUME_CONST uint kBindingOwn = 8u;
BRUME_CONST uint kBindingFirstLights = 31u;  // of passes that draw meshes: LightData[kUniformLights]

// The buffer of lights has room for so many at least.
BRUME_CONST uint kUniformLights = 16u;

// Specialization constants of passes that draw meshes: how many lights there are, and whether the
// camera is orthographic.
BRUME_CONST uint kConstantLightCount = 68u;
BRUME_CONST uint kConstantParallelRays = 70u;
BRUME_CONST uint kUnknownCount = 0xffffffffu;  // the frame says

BRUME_STRUCTS_END
#endif
