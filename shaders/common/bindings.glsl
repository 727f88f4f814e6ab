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
// see the same frame and lights: blocks with constant places are read once, buffers by each. No
// loop and no branch may depend on a block alone: Mesa 22 compiles the shader anew for each draw
// then, with the block's values, and never frees it.
#ifdef BRUME_SURFACE_PASS
layout(binding = kBindingFrame, scalar) uniform FrameBlock { FrameData frame; };
layout(binding = kBindingFirstLights, scalar) uniform FirstLightsBlock {
    LightData firstLights[kUniformLights];
};
layout(constant_id = kConstantLightCount) const uint kLightCount = kUnknownCount;
uint lightCount() { return kLightCount == kUnknownCount ? frame.lightCount : kLightCount; }
layout(constant_id = kConstantParallelRays) const uint kParallelRays = kUnknownCount;
bool hasParallelRays() {
    return kParallelRays == kUnknownCount ? frame.orthographic != 0u : kParallelRays != 0u;
}
LightData lightAt(uint i) {
    if (i >= kUniformLights) return lights[i];
    LightData light = firstLights[i];
    light.type = lights[i].type;  // see above: shaders branch on these
    light.shadow = lights[i].shadow;
    return light;
}
#else
layout(binding = kBindingFrame, scalar) readonly buffer FrameBlock { FrameData frame; };
uint lightCount() { return frame.lightCount; }
bool hasParallelRays() { return frame.orthographic != 0u; }
LightData lightAt(uint i) { return lights[i]; }
#endif
// The first pixel of a tile. Devices without a division of integers do one for each lane of a vector.
uvec2 tileCorner(uint tile) {
    int columns = int(frame.tiles.x);
    int row = int(float(int(tile)) / float(columns));  // may be the one before or behind
    int column = int(tile) - row * columns;
    int off = column < 0 ? -1 : column >= columns ? 1 : 0;
    return uvec2(column - off * columns, row + off) * kTileSize;
}

layout(binding = kBindingMedia, scalar) readonly buffer MediumBuffer { MediumData media[]; };

#endif
