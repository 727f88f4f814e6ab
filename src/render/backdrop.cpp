// SPDX-License-Identifier: Apache-2.0
#include <oit/bindings.hpp>
#include <render/backdrop.hpp>
#include <render/opaque_targets.hpp>

#include <spv/common/screen.vert.hpp>
#include <spv/render/composite.frag.hpp>
#include <spv/render/import.frag.hpp>

namespace brume::render {
namespace {

using frame::Access;
using gpu::BindingType;


gpu::ColorTarget withoutAlpha(VkFormat format) {
    gpu::ColorTarget target{format, {}};
    target.blend.writeMask =
        VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT;
    return target;
}

}  // namespace

Backdrop::Backdrop(gpu::Device& device, VkFormat colorFormat)
    : mImport(device,
              {.name = "render.import",
               .vertexSpirv = spv::common_screen_vert,
               .fragmentSpirv = spv::render_import_frag,
               .bindings = oit::join(oit::frameBindings(),
                                     {{shader::kBindingHostDepth, BindingType::SampledImage},
                                      {shader::kBindingHostColor, BindingType::SampledImage}}),
               .pushConstantBytes = sizeof(shader::BackdropPush),
               .colors = {{kColorFormat, {}}, {kDistanceFormat, {}}},
               .depthFormat = kDepthFormat,
               .depthTest = true,
               .depthWrite = true,
               .depthCompare = VK_COMPARE_OP_ALWAYS}),
      mComposite(device, {.name = "render.composite",
                          .vertexSpirv = spv::common_screen_vert,
                          .fragmentSpirv = spv::render_composite_frag,
                          .bindings = {{shader::kBindingComposed, BindingType::SampledImage}},
                          .pushConstantBytes = sizeof(shader::BackdropPush),
                          .colors = {withoutAlpha(colorFormat)}}) {}

frame::ImageRef Backdrop::declareImport(frame::FrameBuilder& frame, oit::Inputs& inputs,
                                        frame::ImageRef color, frame::ImageRef depth) const {
    createOpaqueTargets(frame, inputs);
    const frame::ImageRef reversed = createOpaqueDepth(frame, inputs);
    frame.addPass("render.import")
        .reads(color, Access::FragmentSample)
        .reads(depth, Access::FragmentSample)
        .color(inputs.opaqueColor, gpu::LoadOp::DontCare)
        .color(inputs.opaqueT, gpu::LoadOp::DontCare)
        .depth(reversed, gpu::LoadOp::Clear)
        .record([this, inputs, color, depth](gpu::Commands& commands,
                                             const frame::PassResources& resources) {
            commands.bindGraphics(mImport);
            oit::bindFrame(commands, inputs);
            commands.bind(shader::kBindingHostDepth, resources.image(depth), *inputs.texelSampler);
            commands.bind(shader::kBindingHostColor, resources.image(color), *inputs.texelSampler);
            commands.pushConstants(mPush);
            commands.draw(3);
        });
    return reversed;
}

void Backdrop::declareComposite(frame::FrameBuilder& frame, const oit::Inputs& inputs,
                                frame::ImageRef color) const {
    frame.addPass("render.composite")
        .reads(inputs.result, Access::FragmentSample)
        .color(color, gpu::LoadOp::Load)
        .record([this, inputs, color](gpu::Commands& commands,
                                      const frame::PassResources& resources) {
            const VkExtent2D size = inputs.extent;
            commands.setViewport({static_cast<float>(mPush.offsetX),
                                  static_cast<float>(mPush.offsetY), static_cast<float>(size.width),
                                  static_cast<float>(size.height), 0, 1});
            commands.setScissor({{static_cast<std::int32_t>(mPush.offsetX),
                                  static_cast<std::int32_t>(mPush.offsetY)},
                                 size});
            commands.bindGraphics(mComposite);
            commands.bind(shader::kBindingComposed, resources.image(inputs.result),
                          *inputs.texelSampler);
            commands.pushConstants(mPush);
            commands.draw(3);
        });
}

}  // namespace brume::render
