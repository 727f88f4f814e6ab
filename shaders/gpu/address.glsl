// SPDX-License-Identifier: Apache-2.0
// Arrays behind 64-bit addresses: they may exceed the largest storage-buffer binding.
#ifndef BRUME_GPU_ADDRESS_GLSL
#define BRUME_GPU_ADDRESS_GLSL
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_scalar_block_layout : require

layout(buffer_reference, scalar) buffer UintArray { uint at[]; };
layout(buffer_reference, scalar) readonly buffer FloatArray { float at[]; };
layout(buffer_reference, scalar) buffer Uvec2Array { uvec2 at[]; };

#endif
