// SPDX-License-Identifier: Apache-2.0
#include <gpu/upload.hpp>
#include <view/ui_pass.hpp>

#include <shaders/view/ui.h>
#include <spv/view/picture.frag.hpp>
#include <spv/view/ui.frag.hpp>
#include <spv/view/ui.vert.hpp>

#include <imgui.h>

#include <algorithm>
#include <cstring>

namespace brume::view {
namespace {

static_assert(sizeof(ImDrawVert) == sizeof(shader::UiVertex));

gpu::GraphicsPipeline makePipeline(gpu::Device& device, const char* name,
                                   std::span<const std::uint32_t> fragment, VkFormat format) {
    return {device,
            {.name = name,
             .vertexSpirv = spv::view_ui_vert,
             .fragmentSpirv = fragment,
             .bindings = {{shader::kBindingUiVertices, gpu::BindingType::StorageBuffer},
                          {shader::kBindingUiTexture, gpu::BindingType::SampledImage}},
             .pushConstantBytes = sizeof(shader::UiPush),
             .colors = {{format, gpu::Blend::custom(VK_BLEND_FACTOR_SRC_ALPHA,
                                                    VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA)}}}};
}

/// Makes the buffer large enough.
void reserve(gpu::Device& device, gpu::Buffer& buffer, const char* name, std::uint64_t bytes) {
    if (buffer.bytes() >= bytes && buffer) return;
    buffer = gpu::Buffer(device, {.name = name,
                                  .bytes = std::max<std::uint64_t>(2 * bytes, 1 << 16),
                                  .memory = gpu::MemoryKind::Upload});
}

}  // namespace

UiPass::UiPass(gpu::Submitter& submitter, VkFormat format)
    : mDevice(&submitter.device()),
      mUi(makePipeline(*mDevice, "view.ui", spv::view_ui_frag, format)),
      mPicture(makePipeline(*mDevice, "view.picture", spv::view_picture_frag, format)),
      mSmooth(*mDevice, {.name = "view.smooth", .filter = gpu::Filter::Linear}),
      mTexels(*mDevice, {.name = "view.texels", .filter = gpu::Filter::Nearest}) {
    uploadFont(submitter);
}

void UiPass::uploadFont(gpu::Submitter& submitter) {
    unsigned char* texels = nullptr;
    int width = 0, height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&texels, &width, &height);
    mFont = gpu::Image(*mDevice, {.name = "view.font",
                                  .format = VK_FORMAT_R8_UNORM,
                                  .width = static_cast<std::uint32_t>(width),
                                  .height = static_cast<std::uint32_t>(height)});
    submitter.submitAndWait("upload font", [&](gpu::Commands& commands) {
        gpu::upload(commands, mFont,
                    std::span(texels, static_cast<std::size_t>(width) * height));
    });
}

void UiPass::fill(const ImDrawData& data) {
    reserve(*mDevice, mVertices, "view.vertices",
            std::max(data.TotalVtxCount, 1) * sizeof(ImDrawVert));
    reserve(*mDevice, mIndices, "view.indices",
            std::max(data.TotalIdxCount, 1) * sizeof(std::uint32_t));
    auto* vertices = static_cast<ImDrawVert*>(mVertices.mapped());
    auto* indices = static_cast<std::uint32_t*>(mIndices.mapped());
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        vertices = std::copy(list.VtxBuffer.begin(), list.VtxBuffer.end(), vertices);
        indices = std::copy(list.IdxBuffer.begin(), list.IdxBuffer.end(), indices);
    }
}

void UiPass::record(gpu::Commands& commands, const ImDrawData& data, const gpu::Image& target) {
    fill(data);
    commands.transition(target, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, true);
    const gpu::ColorAttachment color{&target, gpu::LoadOp::Clear, {0, 0, 0, 1}};
    commands.beginRendering(std::span(&color, 1));
    commands.bindIndexBuffer(mIndices);
    std::uint32_t firstVertex = 0, firstIndex = 0;
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        drawList(commands, data, list, firstVertex, firstIndex, target);
        firstVertex += static_cast<std::uint32_t>(list.VtxBuffer.Size);
        firstIndex += static_cast<std::uint32_t>(list.IdxBuffer.Size);
    }
    commands.endRendering();
}

void UiPass::drawList(gpu::Commands& commands, const ImDrawData& data, const ImDrawList& list,
                      std::uint32_t firstVertex, std::uint32_t firstIndex,
                      const gpu::Image& target) const {
    const vec2 size(data.DisplaySize.x, data.DisplaySize.y);
    const vec2 pixels(data.FramebufferScale.x, data.FramebufferScale.y);
    const vec2 limit(target.extent().width, target.extent().height);
    shader::UiPush push{.scale = 2.0f / size, .offset = vec2(-1), .gain = 1};
    for (const ImDrawCmd& command : list.CmdBuffer) {
        const vec2 from = glm::clamp(vec2(command.ClipRect.x, command.ClipRect.y) * pixels,
                                     vec2(0), limit);
        const vec2 to = glm::clamp(vec2(command.ClipRect.z, command.ClipRect.w) * pixels, vec2(0),
                                   limit);
        if (command.ElemCount == 0 || to.x <= from.x || to.y <= from.y) continue;
        const auto* picture = static_cast<const UiPicture*>(command.TextureId);
        commands.bindGraphics(picture ? mPicture : mUi);
        commands.bind(shader::kBindingUiVertices, mVertices);
        if (picture)
            commands.bind(shader::kBindingUiTexture, *picture->image,
                          picture->isSmooth ? mSmooth : mTexels);
        else
            commands.bind(shader::kBindingUiTexture, mFont, mSmooth);
        push.gain = picture ? picture->gain : 1;
        commands.pushConstants(push);
        commands.setScissor({{static_cast<std::int32_t>(from.x), static_cast<std::int32_t>(from.y)},
                             {static_cast<std::uint32_t>(to.x - from.x),
                              static_cast<std::uint32_t>(to.y - from.y)}});
        commands.drawIndexed(command.ElemCount, 1, firstIndex + command.IdxOffset,
                             static_cast<std::int32_t>(firstVertex + command.VtxOffset));
    }
}

}  // namespace brume::view
