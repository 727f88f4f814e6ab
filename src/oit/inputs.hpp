// SPDX-License-Identifier: Apache-2.0
// What a method gets to see of a frame: the media, the surfaces, what lies behind them, and what
// of all that the scene really uses.
#pragma once

#include <frame/frame_builder.hpp>

#include <cstdint>
#include <vector>

namespace brume::oit {

/// What a scene uses. Methods specialise their pipelines by it and allocate for nothing else.
struct Needs {
    bool spheres = false;
    bool uniformSpheres = false;      ///< some are of constant density
    bool boxes = false;               ///< bricks, tiles or boxes of volumes
    bool surfaces = false;            ///< thin or solid triangles
    bool opaque = false;              ///< something may be opaque: meshes, or what a host has drawn
    bool varyingDensity = false;      ///< smooth spheres, bricks, soft boxes
    bool varyingLight = false;        ///< on media that scatter: point or spot lights, or shadows
                                      ///< asked for at each place
    bool lamps = false;               ///< point or spot lights on media that scatter
    bool pointLights = false;         ///< there are lights that are not directional
    bool wholeShadows = false;        ///< some spheres that scatter are shadowed as a whole
    bool solids = false;              ///< closed meshes among the surfaces
    bool colouredExtinction = false;  ///< extinction of media or solids differs between channels
    bool colouredSurfaces = false;    ///< transmission of thin surfaces does
    bool environment = false;         ///< the background is a picture, not the same everywhere
    bool hostLayers = false;          ///< a host draws surfaces of its own into the method's targets
    bool textured = false;            ///< some material has a texture
    bool glossy = false;              ///< glass that mirrors background and lights
    bool diffusion = false;           ///< thin surfaces with a collimation below 1
    bool tinted = false;     ///< spheres have different tints
    bool oneMedium = false;  ///< one medium and one tint in the whole scene
    bool oneSource = false;  ///< and light that is the same everywhere: what media send depends on
                             ///< nothing but their summed depth
    bool orthographic = false;
    float largestTint = 1;  ///< of all media, over channels and time
    std::uint32_t media = 0;
    std::uint32_t lights = 0;         ///< without ambient ones
    std::uint32_t shadowStores = 0;   ///< bits of shaders/shadows/common/maps.h
    std::uint32_t shadowing = 0;      ///< likewise; 0 where there are no stores

    bool operator==(const Needs&) const = default;
};

/// One mesh of thin or solid triangles.
struct SurfaceDraw {
    std::uint32_t mesh = 0;      ///< index into the meshes
    std::uint32_t material = 0;  ///< index into the materials
    std::uint32_t vertexCount = 0;
    bool isSolid = false;
    const gpu::Image* colorTexture = nullptr;
    const gpu::Image* emissionTexture = nullptr;
};

/// Rendering that the frame's caller begins and ends, for methods that draw into it directly.
struct CallersRendering {
    VkFormat color = VK_FORMAT_UNDEFINED;  ///< undefined: there is none
    VkFormat depth = VK_FORMAT_UNDEFINED;  ///< attached, but neither tested nor written
    explicit operator bool() const { return color != VK_FORMAT_UNDEFINED; }
};

/// Buffers are bound as shaders/common/bindings.glsl and mesh.h say; those that the frame itself
/// writes are BufferRefs. All outlive the frame.
struct Inputs {
    Needs needs;
    VkExtent2D extent{};
    std::uint32_t supersample = 1;         ///< n x n pixels of the extent are one of the image
    const gpu::Buffer* frame = nullptr;    ///< FrameData
    const gpu::Buffer* lights = nullptr;   ///< LightData[]
    const gpu::Buffer* media = nullptr;    ///< MediumData[]
    const gpu::Buffer* boxes = nullptr;    ///< BoxData[boxCount]
    const gpu::Buffer* volumes = nullptr;  ///< VolumeData[]
    const gpu::Buffer* vertices = nullptr;
    const gpu::Buffer* indices = nullptr;
    const gpu::Buffer* meshes = nullptr;           ///< MeshData, one every kUniformStride bytes
    const gpu::Buffer* materials = nullptr;        ///< MaterialData, likewise
    const gpu::Image* environment = nullptr;  ///< RGBA32F, one texel where there is none
    const gpu::Sampler* texelSampler = nullptr;    ///< nearest, for texelFetch
    std::uint32_t sphereCount = 0;                 ///< slots; those with radius 0 are empty
    std::uint32_t boxCount = 0;
    bool sphereIdsAscend = true;  ///< spheres stand in the order of their ids
    std::vector<SurfaceDraw> surfaces;
    frame::BufferRef spheres;  ///< SphereData[sphereCount]
    frame::ImageRef
        opaqueT;  ///< R32F, distance of the opaque surface along the ray; 3e38 where there is none
    frame::ImageRef opaqueColor;  ///< RGBA32F, its radiance or the background's
    frame::ImageRef result;       ///< RGBA32F, to be written whole
    CallersRendering callers;     ///< instead of result: methods unordered and sorted only
};

}  // namespace brume::oit
