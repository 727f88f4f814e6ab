// SPDX-License-Identifier: Apache-2.0
// Transfers, labels and barriers.
#include <volk.h>
// volk.h goes first.
#include <gpu/commands.hpp>

#include <algorithm>

namespace brume::gpu {
namespace {

VkBufferImageCopy2 copyRegion(const Image& image, std::uint64_t offset) {
    VkBufferImageCopy2 region{};
    region.sType = VK_STRUCTURE_TYPE_BUFFER_IMAGE_COPY_2;
    region.bufferOffset = offset;
    region.imageSubresource = {image.aspect(), 0, 0, image.range().layerCount};
    region.imageExtent = image.extent3d();
    return region;
}

}  // namespace

void Commands::fillBuffer(const Buffer& buffer, std::uint32_t value, std::uint64_t offset,
                          std::uint64_t bytes) {
    mDevice->vk().vkCmdFillBuffer(mHandle, buffer.handle(), offset, bytes, value);
}

void Commands::updateBuffer(const Buffer& buffer, const void* data, std::uint64_t bytes,
                            std::uint64_t offset) {
    mDevice->vk().vkCmdUpdateBuffer(mHandle, buffer.handle(), offset, bytes, data);
}

void Commands::copyBuffer(const Buffer& source, const Buffer& target, std::uint64_t bytes,
                          std::uint64_t sourceOffset, std::uint64_t targetOffset) {
    const VkBufferCopy region{sourceOffset, targetOffset, bytes};
    mDevice->vk().vkCmdCopyBuffer(mHandle, source.handle(), target.handle(), 1, &region);
}

void Commands::copyImageToBuffer(const Image& source, const Buffer& target, std::uint64_t offset) {
    const VkBufferImageCopy2 region = copyRegion(source, offset);
    VkCopyImageToBufferInfo2 info{};
    info.sType = VK_STRUCTURE_TYPE_COPY_IMAGE_TO_BUFFER_INFO_2;
    info.srcImage = source.handle();
    info.srcImageLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    info.dstBuffer = target.handle();
    info.regionCount = 1;
    info.pRegions = &region;
    mDevice->vk().vkCmdCopyImageToBuffer2(mHandle, &info);
}

void Commands::copyBufferToImage(const Buffer& source, const Image& target, std::uint64_t offset) {
    const VkBufferImageCopy2 region = copyRegion(target, offset);
    VkCopyBufferToImageInfo2 info{};
    info.sType = VK_STRUCTURE_TYPE_COPY_BUFFER_TO_IMAGE_INFO_2;
    info.srcBuffer = source.handle();
    info.dstImage = target.handle();
    info.dstImageLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    info.regionCount = 1;
    info.pRegions = &region;
    mDevice->vk().vkCmdCopyBufferToImage2(mHandle, &info);
}

void Commands::copyImage(const Image& source, const Image& target) {
    VkImageCopy region{};
    region.srcSubresource = {source.aspect(), 0, 0, source.range().layerCount};
    region.dstSubresource = {target.aspect(), 0, 0, target.range().layerCount};
    region.extent = source.extent3d();
    mDevice->vk().vkCmdCopyImage(mHandle, source.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                 target.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

void Commands::clearColorImage(const Image& image, const std::array<float, 4>& value) {
    VkClearColorValue color{};
    std::copy(value.begin(), value.end(), color.float32);
    const VkImageSubresourceRange range = image.range();
    mDevice->vk().vkCmdClearColorImage(mHandle, image.handle(), image.layout(), &color, 1, &range);
}

void Commands::clearColorImage(const Image& image, const std::array<std::uint32_t, 4>& value) {
    VkClearColorValue color{};
    std::copy(value.begin(), value.end(), color.uint32);
    const VkImageSubresourceRange range = image.range();
    mDevice->vk().vkCmdClearColorImage(mHandle, image.handle(), image.layout(), &color, 1, &range);
}

void Commands::beginLabel(const char* name) { mDevice->beginLabel(mHandle, name); }
void Commands::endLabel() { mDevice->endLabel(mHandle); }

void Commands::pipelineBarrier(const VkDependencyInfo& dependency) {
    mDevice->vk().vkCmdPipelineBarrier2(mHandle, &dependency);
}

void Commands::memoryBarrier(VkPipelineStageFlags2 sourceStages, VkAccessFlags2 sourceAccess,
                             VkPipelineStageFlags2 targetStages, VkAccessFlags2 targetAccess) {
    VkMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
    barrier.srcStageMask = sourceStages;
    barrier.srcAccessMask = sourceAccess;
    barrier.dstStageMask = targetStages;
    barrier.dstAccessMask = targetAccess;
    VkDependencyInfo dependency{};
    dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    dependency.memoryBarrierCount = 1;
    dependency.pMemoryBarriers = &barrier;
    pipelineBarrier(dependency);
}

void Commands::computeBarrier() {
    memoryBarrier(VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_WRITE_BIT,
                  VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                  VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_SHADER_WRITE_BIT |
                      VK_ACCESS_2_UNIFORM_READ_BIT | VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT);
}

void Commands::computeTransferBarrier() {
    constexpr VkPipelineStageFlags2 kStages =
        VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    memoryBarrier(kStages, VK_ACCESS_2_SHADER_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT,
                  kStages | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                  VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_SHADER_WRITE_BIT |
                      VK_ACCESS_2_UNIFORM_READ_BIT | VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT |
                      VK_ACCESS_2_TRANSFER_READ_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT);
}

void Commands::fullBarrier() {
    memoryBarrier(
        VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT,
        VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_2_HOST_BIT,
        VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT | VK_ACCESS_2_HOST_READ_BIT);
}

void Commands::transition(const Image& image, VkImageLayout layout, bool discard) {
    VkImageMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.oldLayout = discard ? VK_IMAGE_LAYOUT_UNDEFINED : image.layout();
    barrier.newLayout = layout;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image.handle();
    barrier.subresourceRange = image.range();
    VkDependencyInfo dependency{};
    dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    dependency.imageMemoryBarrierCount = 1;
    dependency.pImageMemoryBarriers = &barrier;
    pipelineBarrier(dependency);
    image.setLayout(layout);
}

}  // namespace brume::gpu
