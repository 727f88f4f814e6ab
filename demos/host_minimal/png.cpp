// SPDX-License-Identifier: Apache-2.0
// The picture back to the host and into a file.
#include "renderer.hpp"

#include <zlib.h>

#include <cstring>
#include <fstream>

namespace host_minimal {
namespace {

void put(std::string& bytes, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift);
}

void putChunk(std::ofstream& file, const std::string& type, const std::string& data) {
    std::string head, body = type + data, tail;
    put(head, static_cast<std::uint32_t>(data.size()));
    put(tail, static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(body.data()),
                                               static_cast<uInt>(body.size()))));
    file << head << body << tail;
}

void save(const std::string& name, const unsigned char* rgba, std::uint32_t width,
          std::uint32_t height) {
    std::string rows;
    for (std::uint32_t y = 0; y < height; ++y) {
        rows += '\0';  // no filter
        for (std::uint32_t x = 0; x < width; ++x)
            rows.append(reinterpret_cast<const char*>(rgba + 4 * (y * width + x)), 3);
    }
    uLongf size = compressBound(rows.size());
    std::string packed(size, '\0');
    compress(reinterpret_cast<Bytef*>(packed.data()), &size,
             reinterpret_cast<const Bytef*>(rows.data()), rows.size());
    packed.resize(size);
    std::string header;
    put(header, width);
    put(header, height);
    header += std::string("\x08\x02\x00\x00\x00", 5);  // 8-bit RGB
    std::ofstream file(name, std::ios::binary);
    file << "\x89PNG\r\n\x1a\n";
    putChunk(file, "IHDR", header);
    putChunk(file, "IDAT", packed);
    putChunk(file, "IEND", "");
    if (!file) throw std::runtime_error(name + " cannot be written");
}

}  // namespace

void Renderer::writePng(const std::string& file) {
    waitIdle();
    const VkDeviceSize bytes = VkDeviceSize{4} * width * height;
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = bytes;
    info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    VkBuffer buffer = VK_NULL_HANDLE;
    vkCreateBuffer(device, &info, nullptr, &buffer);
    VkMemoryRequirements needed{};
    vkGetBufferMemoryRequirements(device, buffer, &needed);
    VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    allocate.allocationSize = needed.size;
    allocate.memoryTypeIndex =
        findMemory(needed.memoryTypeBits,
                   VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    VkDeviceMemory memory = VK_NULL_HANDLE;
    vkAllocateMemory(device, &allocate, nullptr, &memory);
    vkBindBufferMemory(device, buffer, memory, 0);

    const VkCommandBuffer commands = beginFrame();
    VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_TRANSFER_READ_BIT;
    barrier.oldLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    barrier.newLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = color.image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    dependency.imageMemoryBarrierCount = 1;
    dependency.pImageMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &dependency);
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = {width, height, 1};
    vkCmdCopyImageToBuffer(commands, color.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer, 1,
                           &region);
    endFrame();
    waitIdle();

    void* mapped = nullptr;
    vkMapMemory(device, memory, 0, bytes, 0, &mapped);
    save(file, static_cast<const unsigned char*>(mapped), width, height);
    vkDestroyBuffer(device, buffer, nullptr);
    vkFreeMemory(device, memory, nullptr);
}

}  // namespace host_minimal
