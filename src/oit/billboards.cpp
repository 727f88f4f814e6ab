// SPDX-License-Identifier: Apache-2.0
#include <oit/billboards.hpp>
#include <oit/bindings.hpp>

#include <shaders/common/frame_bindings.h>
#include <shaders/oit/billboards/billboards.h>
#include <spv/common/mesh.vert.hpp>
#include <spv/oit/billboards/media.frag.hpp>
#include <spv/oit/billboards/media.vert.hpp>
#include <spv/oit/billboards/surface.frag.hpp>

namespace brume::oit {
namespace {

using frame::Access;

const gpu::Binding kOpaqueT{shader::kBindingOpaqueT, gpu::BindingType::SampledImage};
const std::vector<gpu::ColorTarget> kOver = {
    {VK_FORMAT_R32G32B32A32_SFLOAT, gpu::Blend::premultipliedOver()}};

}  // namespace

Billboards::Billboards(gpu::Device& device, const std::string& name, const Inputs& inputs)
    : mName("oit." + name),
      mMedia(device, {.name = mName + ".media",
                      .vertexSpirv = spv::oit_billboards_media_vert,
                      .fragmentSpirv = spv::oit_billboards_media_frag,
                      .bindings = join(join(frameBindings(), mediaBindings()), {kOpaqueT}),
                      .pushConstantBytes = sizeof(shader::BillboardPush),
                      .specialization = {inputs.needs.boxes, inputs.needs.varyingDensity,
                                         inputs.needs.colouredExtinction},
                      .constants = lightingConstants(inputs.needs),
                      .colors = kOver}) {
    if (inputs.needs.surfaces)
        mSurfaces = {device,
                     {.name = mName + ".surfaces",
                      .vertexSpirv = spv::common_mesh_vert,
                      .fragmentSpirv = spv::oit_billboards_surface_frag,
                      .bindings = join(join(frameBindings(), meshBindings()), {kOpaqueT}),
                      .constants = lightingConstants(inputs.needs),
                      .colors = kOver}};
}

void Billboards::recordMedia(gpu::Commands& commands, const frame::PassResources& resources,
                             const Inputs& inputs, frame::BufferRef order) const {
    const std::uint32_t count = inputs.sphereCount + inputs.boxCount;
    if (count == 0) return;
    commands.bindGraphics(mMedia);
    bindFrame(commands, inputs);
    bindMedia(commands, inputs, resources.buffer(inputs.spheres), *inputs.boxes);
    commands.bind(shader::kBindingOpaqueT, resources.image(inputs.opaqueT), *inputs.texelSampler);
    commands.pushConstants(
        shader::BillboardPush{.order = order ? resources.address(order) : 0, .count = count});
    commands.draw(6 * count);
}

void Billboards::recordSurfaces(gpu::Commands& commands, const frame::PassResources& resources,
                                const Inputs& inputs) const {
    if (!inputs.needs.surfaces) return;
    commands.bindGraphics(mSurfaces);
    bindFrame(commands, inputs);
    bindMeshes(commands, inputs);
    commands.bind(shader::kBindingOpaqueT, resources.image(inputs.opaqueT), *inputs.texelSampler);
    drawSurfaces(commands, inputs, [](std::uint32_t) {});
}

void Billboards::declare(frame::FrameBuilder& frame, const Inputs& inputs,
                         frame::BufferRef order) const {
    frame.addPass(mName + ".clear")
        .reads(inputs.opaqueColor, Access::TransferRead)
        .writes(inputs.result, Access::TransferWrite)
        .record([inputs](gpu::Commands& commands, const frame::PassResources& resources) {
            commands.copyImage(resources.image(inputs.opaqueColor), resources.image(inputs.result));
        });
    frame::PassBuilder& pass = frame.addPass(mName + ".store");
    pass.reads(inputs.spheres, Access::VertexRead).reads(inputs.opaqueT, Access::FragmentSample);
    if (order) pass.reads(order, Access::VertexRead);
    pass.color(inputs.result, gpu::LoadOp::Load);
    pass.record(
        [this, inputs, order](gpu::Commands& commands, const frame::PassResources& resources) {
            recordMedia(commands, resources, inputs, order);
            recordSurfaces(commands, resources, inputs);
        });
}

}  // namespace brume::oit
