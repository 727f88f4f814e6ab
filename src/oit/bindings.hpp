// SPDX-License-Identifier: Apache-2.0
// Descriptor bindings that many passes share, and how they are filled.
#pragma once

#include <gpu/commands.hpp>
#include <oit/inputs.hpp>

#include <span>
#include <vector>

namespace brume::oit {

/// FrameData, lights and media: in every pass.
std::vector<gpu::Binding> frameBindings();
/// Spheres, boxes and volumes.
std::vector<gpu::Binding> mediaBindings();
/// Of passes that draw meshes: those of frameBindings(), as such passes want them; vertices, indices,
/// meshes, materials and textures. Filled by bindFrame(), bindMeshes() and bindDraw().
std::vector<gpu::Binding> surfaceBindings();
std::vector<gpu::Binding> join(std::vector<gpu::Binding> a, const std::vector<gpu::Binding>& b);

/// Constants of shaders/common/bindings.glsl, lighting.glsl and surface.glsl: for every pipeline that lights
/// something. Without them such a shader keeps the code of all shadow stores and of gloss.
std::vector<gpu::NumberedConstant> lightingConstants(const Needs& needs);

/// The finer of two builds of a shader, where the device has the numbers for it.
std::span<const std::uint32_t> chooseReal(const gpu::Device& device,
                                          std::span<const std::uint32_t> float32,
                                          std::span<const std::uint32_t> float64);

void bindFrame(gpu::Commands& commands, const Inputs& inputs);
/// `spheres` and `boxes`: sorted or as they came.
void bindMedia(gpu::Commands& commands, const Inputs& inputs, const gpu::Buffer& spheres,
               const gpu::Buffer& boxes);
void bindMeshes(gpu::Commands& commands, const Inputs& inputs);

/// The mesh, material and textures of one draw.
void bindDraw(gpu::Commands& commands, const Inputs& inputs, const SurfaceDraw& draw);

/// Binds and draws each surface; push(mesh) sets the push constants.
template <typename Push>
void drawSurfaces(gpu::Commands& commands, const Inputs& inputs, const Push& push) {
    for (const SurfaceDraw& draw : inputs.surfaces) {
        push(draw.mesh);
        bindDraw(commands, inputs, draw);
        commands.draw(draw.vertexCount);
    }
}
}  // namespace brume::oit
