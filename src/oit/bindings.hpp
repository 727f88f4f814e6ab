// SPDX-License-Identifier: Apache-2.0
// Descriptor bindings that many passes share, and how they are filled.
#pragma once

#include <gpu/commands.hpp>
#include <oit/inputs.hpp>

#include <vector>

namespace brume::oit {

/// FrameData, lights and media: in every pass.
std::vector<gpu::Binding> frameBindings();
/// Spheres, boxes and volumes.
std::vector<gpu::Binding> mediaBindings();
/// Vertices, indices, meshes, materials and textures.
std::vector<gpu::Binding> meshBindings();
std::vector<gpu::Binding> join(std::vector<gpu::Binding> a, const std::vector<gpu::Binding>& b);

/// Constants of shaders/common/lighting.glsl and surface.glsl: for every pipeline that lights
/// something. Without them such a shader keeps the code of all shadow stores and of gloss.
std::vector<gpu::NumberedConstant> lightingConstants(const Needs& needs);

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
