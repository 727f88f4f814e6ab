// SPDX-License-Identifier: Apache-2.0
// Lets a header of structs be compiled by C++ and GLSL: include it first. Scalar block layout.
#ifndef BRUME_SHADERS_COMMON_SHARED_H
#define BRUME_SHADERS_COMMON_SHARED_H

#ifdef __cplusplus
#define GLM_FORCE_SILENT_WARNINGS
#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>

namespace brume::shader {
using glm::mat3;
using glm::mat4x3;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;
using uint64_t = std::uint64_t;
}  // namespace brume::shader

#define BRUME_STRUCTS_BEGIN namespace brume::shader {
#define BRUME_STRUCTS_END }
#define BRUME_CONST inline constexpr
#else
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#define BRUME_STRUCTS_BEGIN
#define BRUME_STRUCTS_END
#define BRUME_CONST const
#endif
#endif
