// SPDX-License-Identifier: Apache-2.0
// The frame's own buffers, at the same bindings in every shader (frame_bindings.h).
#ifndef BRUME_COMMON_BINDINGS_GLSL
#define BRUME_COMMON_BINDINGS_GLSL
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "frame.h"
#include "frame_bindings.h"
#include "sphere.h"

layout(binding = kBindingLights, scalar) readonly buffer LightBuffer { LightData lights[]; };

// Passes that draw meshes (BRUME_SURFACE_PASS) run their shader for millions of fragments that all
// see the same frame and lights: blocks with constant places are read once, buffers by each. Their
// loops over lights have a constant length, so that nothing is compiled anew for another frame.
#ifdef BRUME_SURFACE_PASS
layout(binding = kBindingFrame, scalar) uniform FrameBlock { FrameData frame; };
layout(binding = kBindingFirstLights, scalar) uniform FirstLightsBlock {
    LightData firstLights[kUniformLights];
};
layout(constant_id = kConstantLightCount) const uint kLightCount = kUnknownCount;
uint lightCount() { return kLightCount == kUnknownCount ? frame.lightCount : kLightCount; }
LightData lightAt(uint i) {
    if (i < kUniformLights) return firstLights[i];
    return lights[i];
}
#else
layout(binding = kBindingFrame, scalar) readonly buffer FrameBlock { FrameData frame; };
uint lightCount() { return frame.lightCount; }
LightData lightAt(uint i) { return lights[i]; }
#endif
layout(binding = kBindingMedia, scalar) readonly buffer MediumBuffer { MediumData media[]; };

#endif
