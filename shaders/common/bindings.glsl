// SPDX-License-Identifier: Apache-2.0
// The frame's own buffers, at the same bindings in every shader (frame_bindings.h).
#ifndef BRUME_COMMON_BINDINGS_GLSL
#define BRUME_COMMON_BINDINGS_GLSL
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "frame.h"
#include "frame_bindings.h"
#include "sphere.h"

layout(binding = kBindingFrame, scalar) readonly buffer FrameBlock { FrameData frame; };
layout(binding = kBindingLights, scalar) readonly buffer LightBuffer { LightData lights[]; };
layout(binding = kBindingMedia, scalar) readonly buffer MediumBuffer { MediumData media[]; };

#endif
