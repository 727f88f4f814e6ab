// SPDX-License-Identifier: Apache-2.0
#include <volk.h>
// volk.h goes first.
#include <fmt/format.h>
#include <core/assert.hpp>
#include <gpu/commands.hpp>

#include <algorithm>
#include <utility>

namespace brume::gpu {
namespace {

AssertionError misuse(const Pipeline* pipeline, const std::string& problem) {
    return AssertionError(fmt::format("recording with pipeline '{}': {}",
                                      pipeline ? pipeline->name() : "none", problem));
}

bool isInteger(VkFormat format) {
    switch (format) {
        case VK_FORMAT_R8_UINT:
        case VK_FORMAT_R16_UINT:
        case VK_FORMAT_R32_UINT:
        case VK_FORMAT_R32_SINT:
        case VK_FORMAT_R32G32_UINT:
        case VK_FORMAT_R32G32B32A32_UINT:
            return true;
        default:
            return false;
    }
}

VkAttachmentLoadOp toVulkan(LoadOp op) {
    switch (op) {
        case LoadOp::Clear:
            return VK_ATTACHMENT_LOAD_OP_CLEAR;
        case LoadOp::DontCare:
            return VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        default:
            return VK_ATTACHMENT_LOAD_OP_LOAD;
    }
}

VkRenderingAttachmentInfo attachmentInfo(const Image& image, LoadOp load) {
    VkRenderingAttachmentInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    info.imageView = image.view();
    info.imageLayout = image.layout();
    info.loadOp = toVulkan(load);
    info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    return info;
}

VkRenderingAttachmentInfo colorInfo(const ColorAttachment& color) {
    VkRenderingAttachmentInfo info = attachmentInfo(*color.image, color.load);
    if (isInteger(color.image->format()))
        std::copy(color.clearUint.begin(), color.clearUint.end(), info.clearValue.color.uint32);
    else
        std::copy(color.clear.begin(), color.clear.end(), info.clearValue.color.float32);
    return info;
}

VkRenderingAttachmentInfo depthInfo(const DepthAttachment& depth) {
    VkRenderingAttachmentInfo info = attachmentInfo(*depth.image, depth.load);
    info.clearValue.depthStencil.depth = depth.clear;
    if (depth.isReadOnly) info.storeOp = VK_ATTACHMENT_STORE_OP_NONE;
    return info;
}

bool isSame(const VkDescriptorBufferInfo& a, const VkDescriptorBufferInfo& b) {
    return a.buffer == b.buffer && a.offset == b.offset && a.range == b.range;
}

bool isSame(const VkDescriptorImageInfo& a, const VkDescriptorImageInfo& b) {
    return a.sampler == b.sampler && a.imageView == b.imageView && a.imageLayout == b.imageLayout;
}

}  // namespace

void Commands::bindPipeline(const Pipeline& pipeline) {
    mPipeline = &pipeline;
    mBoundCount = 0;
    mIsDirty = true;
    mDevice->vk().vkCmdBindPipeline(mHandle, pipeline.bindPoint(), pipeline.handle());
}

void Commands::pushConstantBytes(const void* data, std::size_t bytes) {
    if (!mPipeline || bytes != mPipeline->pushConstantBytes())
        throw misuse(mPipeline, fmt::format("{} bytes of push constants, needs {}", bytes,
                                            mPipeline ? mPipeline->pushConstantBytes() : 0));
    mDevice->vk().vkCmdPushConstants(mHandle, mPipeline->layout(), mPipeline->stages(), 0,
                                     static_cast<std::uint32_t>(bytes), data);
}

const Binding& Commands::requireBinding(std::uint32_t binding, std::uint32_t element) const {
    if (mPipeline)
        for (const Binding& b : mPipeline->bindings())
            if (b.number == binding && element < b.count) return b;
    throw misuse(mPipeline, fmt::format("it has no binding {}[{}]", binding, element));
}

void Commands::setBound(const Bound& bound) {
    for (Bound& b : std::span(mBound.data(), mBoundCount)) {
        if (b.binding != bound.binding || b.element != bound.element) continue;
        if (isSame(b.buffer, bound.buffer) && isSame(b.image, bound.image)) return;
        b = bound;
        mIsDirty = true;
        return;
    }
    mIsDirty = true;
    if (mBoundCount == kMaxBindings)
        throw misuse(mPipeline, fmt::format("more than {} bindings", kMaxBindings));
    mBound[mBoundCount++] = bound;
}

void Commands::bind(std::uint32_t binding, const Buffer& buffer, std::uint32_t element) {
    bind(binding, BufferRange{&buffer, 0, buffer.bytes()}, element);
}

void Commands::bind(std::uint32_t binding, const BufferRange& range, std::uint32_t element) {
    const Binding& declared = requireBinding(binding, element);
    if (declared.type != BindingType::StorageBuffer && declared.type != BindingType::UniformBuffer)
        throw misuse(mPipeline, fmt::format("binding {} takes no buffer", binding));
    const std::uint64_t bytes =
        range.bytes > 0 ? range.bytes : range.buffer->bytes() - range.offset;
    const std::uint64_t limit = mDevice->limits().maxStorageBufferRange;
    if (range.offset + bytes > range.buffer->bytes() || bytes > limit)
        throw misuse(mPipeline,
                     fmt::format("binding {}: {} bytes at {} of buffer '{}' of {}; a binding "
                                 "covers at most {} bytes, beyond that use the device address",
                                 binding, bytes, range.offset, range.buffer->name(),
                                 range.buffer->bytes(), limit));
    Bound bound;
    bound.binding = binding;
    bound.element = element;
    bound.type = toVulkan(declared.type);
    bound.buffer = {range.buffer->handle(), range.offset, bytes};
    setBound(bound);
}

void Commands::bind(std::uint32_t binding, const Image& image, std::uint32_t element) {
    if (requireBinding(binding, element).type != BindingType::StorageImage)
        throw misuse(mPipeline, fmt::format("binding {} takes no storage image", binding));
    Bound bound;
    bound.binding = binding;
    bound.element = element;
    bound.type = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    bound.image = {VK_NULL_HANDLE, image.view(), VK_IMAGE_LAYOUT_GENERAL};
    setBound(bound);
}

void Commands::bind(std::uint32_t binding, const Image& image, const Sampler& sampler,
                    std::uint32_t element) {
    if (requireBinding(binding, element).type != BindingType::SampledImage)
        throw misuse(mPipeline, fmt::format("binding {} takes no sampled image", binding));
    Bound bound;
    bound.binding = binding;
    bound.element = element;
    bound.type = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    bound.image = {sampler.handle(), image.view(), image.layout()};
    setBound(bound);
}

void Commands::flush(VkPipelineBindPoint bindPoint) {
    if (!mPipeline || mPipeline->bindPoint() != bindPoint)
        throw misuse(mPipeline, "it is of the wrong kind for this command");
    if (!mIsDirty) return;
    const std::span bounds(mBound.data(), mBoundCount);
    for (const Binding& b : mPipeline->bindings())
        for (std::uint32_t element = 0; element < b.count; ++element)
            if (std::none_of(bounds.begin(), bounds.end(), [&](const Bound& bound) {
                    return bound.binding == b.number && bound.element == element;
                }))
                throw misuse(mPipeline,
                             fmt::format("binding {}[{}] is missing", b.number, element));
    std::array<VkWriteDescriptorSet, kMaxBindings> writes;
    std::uint32_t count = 0;
    for (Bound& bound : bounds) {
        if (std::exchange(bound.isPushed, true)) continue;
        VkWriteDescriptorSet& write = writes[count++];
        write = {};
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstBinding = bound.binding;
        write.dstArrayElement = bound.element;
        write.descriptorCount = 1;
        write.descriptorType = bound.type;
        write.pBufferInfo = &bound.buffer;
        write.pImageInfo = &bound.image;
    }
    if (count > 0)
        mDevice->vk().vkCmdPushDescriptorSetKHR(mHandle, bindPoint, mPipeline->layout(), 0, count,
                                                writes.data());
    mIsDirty = false;
}

void Commands::dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    flush(VK_PIPELINE_BIND_POINT_COMPUTE);
    const std::uint32_t* most = mDevice->limits().maxGroupCount;
    if (x > most[0] || y > most[1] || z > most[2])
        throw misuse(mPipeline, fmt::format("{}x{}x{} groups, at most {}x{}x{} are allowed", x, y,
                                            z, most[0], most[1], most[2]));
    if (x == 0 || y == 0 || z == 0) return;
    ++mDispatchCount;
    mDevice->vk().vkCmdDispatch(mHandle, x, y, z);
}

void Commands::dispatchThreads(std::uint64_t threads, std::uint32_t groupSize) {
    const std::uint64_t groups = (threads + groupSize - 1) / groupSize;
    const std::uint64_t most = mDevice->limits().maxGroupCount[0];
    const std::uint64_t rows = std::max<std::uint64_t>((groups + most - 1) / most, 1);
    dispatch(static_cast<std::uint32_t>((groups + rows - 1) / rows),
             static_cast<std::uint32_t>(rows));
}

void Commands::dispatchIndirect(const Buffer& arguments, std::uint64_t offset) {
    flush(VK_PIPELINE_BIND_POINT_COMPUTE);
    ++mDispatchCount;
    mDevice->vk().vkCmdDispatchIndirect(mHandle, arguments.handle(), offset);
}

void Commands::draw(std::uint32_t vertices, std::uint32_t instances, std::uint32_t firstVertex,
                    std::uint32_t firstInstance) {
    flush(VK_PIPELINE_BIND_POINT_GRAPHICS);
    mDevice->vk().vkCmdDraw(mHandle, vertices, instances, firstVertex, firstInstance);
}

void Commands::drawIndirect(const Buffer& arguments, std::uint64_t offset, std::uint32_t draws,
                            std::uint32_t stride) {
    flush(VK_PIPELINE_BIND_POINT_GRAPHICS);
    mDevice->vk().vkCmdDrawIndirect(mHandle, arguments.handle(), offset, draws, stride);
}

void Commands::bindIndexBuffer(const Buffer& buffer, std::uint64_t offset) {
    mDevice->vk().vkCmdBindIndexBuffer(mHandle, buffer.handle(), offset, VK_INDEX_TYPE_UINT32);
}

void Commands::drawIndexed(std::uint32_t indices, std::uint32_t instances, std::uint32_t firstIndex,
                           std::int32_t vertexOffset, std::uint32_t firstInstance) {
    flush(VK_PIPELINE_BIND_POINT_GRAPHICS);
    mDevice->vk().vkCmdDrawIndexed(mHandle, indices, instances, firstIndex, vertexOffset,
                                   firstInstance);
}

void Commands::drawIndexedIndirect(const Buffer& arguments, std::uint64_t offset,
                                   std::uint32_t draws, std::uint32_t stride) {
    flush(VK_PIPELINE_BIND_POINT_GRAPHICS);
    mDevice->vk().vkCmdDrawIndexedIndirect(mHandle, arguments.handle(), offset, draws, stride);
}

void Commands::beginRendering(std::span<const ColorAttachment> colors,
                              const std::optional<DepthAttachment>& depth, VkExtent2D area) {
    if (area.width == 0 && !colors.empty()) area = colors[0].image->extent();
    if (area.width == 0 && depth) area = depth->image->extent();
    if (area.width == 0) throw AssertionError("beginRendering: no attachment and no area");
    if (colors.size() > kMaxColors) throw AssertionError("beginRendering: too many colours");
    std::array<VkRenderingAttachmentInfo, kMaxColors> colorInfos;
    std::transform(colors.begin(), colors.end(), colorInfos.begin(), colorInfo);
    VkRenderingAttachmentInfo depthAttachment{};
    if (depth) depthAttachment = depthInfo(*depth);
    VkRenderingInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    info.renderArea = {{0, 0}, area};
    info.layerCount = 1;
    info.colorAttachmentCount = static_cast<std::uint32_t>(colors.size());
    info.pColorAttachments = colorInfos.data();
    info.pDepthAttachment = depth ? &depthAttachment : nullptr;
    mDevice->vk().vkCmdBeginRendering(mHandle, &info);
    setViewport({0, 0, static_cast<float>(area.width), static_cast<float>(area.height), 0, 1});
    setScissor(info.renderArea);
}

void Commands::endRendering() { mDevice->vk().vkCmdEndRendering(mHandle); }

void Commands::setScissor(const VkRect2D& scissor) {
    mDevice->vk().vkCmdSetScissor(mHandle, 0, 1, &scissor);
}

void Commands::setViewport(const VkViewport& viewport) {
    mDevice->vk().vkCmdSetViewport(mHandle, 0, 1, &viewport);
}

}  // namespace brume::gpu
