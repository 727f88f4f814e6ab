// SPDX-License-Identifier: Apache-2.0
// Everything that can take light away, in device memory.
#pragma once

#include <core/math.hpp>
#include <gpu/buffer.hpp>

#include <cstdint>

namespace brume::shadows {

/// Buffers as shaders/common/bindings.glsl and shaders/shadows/common/maps.h say; all outlive the
/// maps made of them. Positions are relative to `origin`.
struct Casters {
    dvec3 origin{0};          ///< of device coordinates, in the world
    Box3 opaqueBounds;        ///< world
    Box3 translucentBounds;   ///< world: media, thin and solid surfaces
    bool isColoured = false;  ///< some caster takes unequal shares of the channels
    const gpu::Buffer* frame = nullptr;
    const gpu::Buffer* lights = nullptr;
    const gpu::Buffer* media = nullptr;
    const gpu::Buffer* spheres = nullptr;
    const gpu::Buffer* boxes = nullptr;
    const gpu::Buffer* volumes = nullptr;
    const gpu::Buffer* triangles = nullptr;  ///< ShadowTriangle[], the opaque ones first
    const gpu::Buffer* materials = nullptr;  ///< ShadowMaterial[]
    std::uint32_t sphereCount = 0;
    bool hasWholeSpheres = false;  ///< some of them are shadowed as a whole
    std::uint32_t boxCount = 0;
    std::uint32_t opaqueTriangleCount = 0;
    std::uint32_t translucentTriangleCount = 0;
};

}  // namespace brume::shadows
