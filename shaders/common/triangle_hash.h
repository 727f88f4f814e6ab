// SPDX-License-Identifier: Apache-2.0
// Which triangles does a pixel see? Both renderers sum this hash and compare; C++ and GLSL.
#ifndef BRUME_SHADERS_COMMON_TRIANGLE_HASH_H
#define BRUME_SHADERS_COMMON_TRIANGLE_HASH_H

#ifdef __cplusplus
#include <cstdint>
namespace brume::shader {
using uint = std::uint32_t;
inline
#endif
    // PCG output function (O'Neill 2014). `meshIndex`: in Scene::meshes; `triangleIndex`: in the
    // mesh.
    uint
    triangleHash(uint meshIndex, uint triangleIndex) {
    uint state = (meshIndex * 0x9e3779b9u + triangleIndex) * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

#ifdef __cplusplus
}  // namespace brume::shader
#endif
#endif
