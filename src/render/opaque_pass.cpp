// SPDX-License-Identifier: Apache-2.0
#include <oit/bindings.hpp>
#include <render/opaque_pass.hpp>
#include <render/opaque_targets.hpp>

#include <shaders/common/frame_bindings.h>
#include <shaders/common/mesh.h>
#include <spv/common/mesh.vert.float64.hpp>
#include <spv/common/mesh.vert.hpp>
#include <spv/common/screen.vert.hpp>
#include <spv/render/background.frag.hpp>
#include <spv/render/opaque.frag.float64.hpp>
#include <spv/render/opaque.frag.hpp>
#include <spv/render/triangles.frag.float64.hpp>
#include <spv/render/triangles.frag.hpp>

namespace brume::render {
namespace {

using frame::Access;


void drawMeshes(gpu::Commands& commands, const oit::Inputs& inputs,
                const std::vector<oit::SurfaceDraw>& draws, bool pushesMesh) {
    for (const oit::SurfaceDraw& draw : draws) {
        if (pushesMesh) commands.pushConstants(shader::MeshPush{draw.mesh});
        oit::bindDraw(commands, inputs, draw);
        commands.draw(draw.vertexCount);
    }
}

}  // namespace

OpaquePass::OpaquePass(gpu::Device& device, const oit::Needs& needs)
    : mBackground(device,
                  {.name = "render.background",
                   .vertexSpirv = spv::common_screen_vert,
                   .fragmentSpirv = spv::render_background_frag,
                   .bindings = oit::join(oit::frameBindings(),
                                         {{shader::kBindingOwn, gpu::BindingType::SampledImage}}),
                   .specialization = {needs.environment},
                   .colors = {{kColorFormat, {}}, {kDistanceFormat, {}}}}),
      mOpaque(device, {.name = "render.opaque",
                       .vertexSpirv = oit::chooseReal(device, spv::common_mesh_vert,
                                                      spv::common_mesh_vert_float64),
                       .fragmentSpirv = oit::chooseReal(device, spv::render_opaque_frag,
                                                        spv::render_opaque_frag_float64),
                       .bindings = oit::surfaceBindings(),
                       .constants = oit::lightingConstants(needs),
                       .colors = {{kColorFormat, {}}, {kDistanceFormat, {}}},
                       .depthFormat = kDepthFormat,
                       .depthTest = true,
                       .depthWrite = true}),
      mTriangles(device, {.name = "render.triangles",
                          .vertexSpirv = oit::chooseReal(device, spv::common_mesh_vert,
                                                         spv::common_mesh_vert_float64),
                          .fragmentSpirv = oit::chooseReal(device, spv::render_triangles_frag,
                                                           spv::render_triangles_frag_float64),
                          .bindings = oit::join(
                              oit::surfaceBindings(),
                              {{shader::kBindingOpaqueT, gpu::BindingType::SampledImage},
                               {shader::kBindingTriangles, gpu::BindingType::StorageBuffer}}),
                          .pushConstantBytes = sizeof(shader::MeshPush),
                          .constants = oit::lightingConstants(needs)}) {}

void OpaquePass::declare(frame::FrameBuilder& frame, const GpuScene& scene,
                         oit::Inputs& inputs) const {
    createOpaqueTargets(frame, inputs);
    frame.addPass("render.background")
        .color(inputs.opaqueColor, gpu::LoadOp::DontCare)
        .color(inputs.opaqueT, gpu::LoadOp::DontCare)
        .record([this, &scene, inputs](gpu::Commands& commands, const frame::PassResources&) {
            commands.bindGraphics(mBackground);
            oit::bindFrame(commands, inputs);
            commands.bind(shader::kBindingOwn, scene.environment(), *inputs.texelSampler);
            commands.draw(3);
        });
    if (scene.opaqueMeshes().empty()) return;
    declareMeshes(frame, scene, inputs, createOpaqueDepth(frame, inputs),
                  gpu::LoadOp::Clear);
}

void OpaquePass::declareMeshes(frame::FrameBuilder& frame, const GpuScene& scene,
                               const oit::Inputs& inputs, frame::ImageRef depth,
                               gpu::LoadOp load) const {
    if (scene.opaqueMeshes().empty()) return;
    frame.addPass("render.opaque")
        .color(inputs.opaqueColor, gpu::LoadOp::Load)
        .color(inputs.opaqueT, gpu::LoadOp::Load)
        .depth(depth, load)
        .record([this, &scene, inputs](gpu::Commands& commands, const frame::PassResources&) {
            commands.bindGraphics(mOpaque);
            oit::bindFrame(commands, inputs);
            oit::bindMeshes(commands, inputs);
            drawMeshes(commands, inputs, scene.opaqueMeshes(), false);
        });
}

void OpaquePass::declareTriangles(frame::FrameBuilder& frame, const GpuScene& scene,
                                  const oit::Inputs& inputs, const gpu::Buffer& triangles) const {
    const frame::BufferRef target = frame.importBuffer(triangles);
    frame.addPass("render.triangles_clear")
        .writes(target, Access::TransferWrite)
        .record([&triangles](gpu::Commands& commands, const frame::PassResources&) {
            commands.fillBuffer(triangles, 0);
        });
    frame.addPass("render.triangles")
        .reads(inputs.opaqueT, Access::FragmentSample)
        .readsWrites(target, Access::FragmentWrite)
        .renderArea(inputs.extent)
        .record([this, &scene, inputs, &triangles](gpu::Commands& commands,
                                                   const frame::PassResources& resources) {
            commands.bindGraphics(mTriangles);
            oit::bindFrame(commands, inputs);
            oit::bindMeshes(commands, inputs);
            commands.bind(shader::kBindingOpaqueT, resources.image(inputs.opaqueT),
                          *inputs.texelSampler);
            commands.bind(shader::kBindingTriangles, triangles);
            drawMeshes(commands, inputs, scene.opaqueMeshes(), true);
            drawMeshes(commands, inputs, inputs.surfaces, true);
        });
}

}  // namespace brume::render
