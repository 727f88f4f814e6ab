// SPDX-License-Identifier: Apache-2.0
#include <gpu/upload.hpp>

#include <fmt/format.h>
#include <core/assert.hpp>

#include <cstring>

namespace brume::gpu {
namespace {

Buffer makeStaging(Commands& commands, const std::string& target,
                   std::span<const std::byte> bytes) {
    if (!commands.device().isFrameOpen())
        throw AssertionError(fmt::format("uploading '{}': no frame has begun", target));
    Buffer staging(
        commands.device(),
        {.name = "upload " + target, .bytes = bytes.size(), .memory = MemoryKind::Upload});
    std::memcpy(staging.mapped(), bytes.data(), bytes.size());
    return staging;
}

}  // namespace

void uploadBytes(Commands& commands, const Buffer& target, std::span<const std::byte> bytes,
                 std::uint64_t offset) {
    if (bytes.empty()) return;
    if (offset + bytes.size() > target.bytes())
        throw AssertionError(fmt::format("uploading '{}': {} bytes at {} of {}", target.name(),
                                         bytes.size(), offset, target.bytes()));
    const Buffer staging = makeStaging(commands, target.name(), bytes);
    commands.fullBarrier();
    commands.copyBuffer(staging, target, bytes.size(), 0, offset);
    commands.fullBarrier();
}

void uploadBytes(Commands& commands, const Image& target, std::span<const std::byte> bytes) {
    const VkExtent3D extent = target.extent3d();
    const std::uint64_t needed = std::uint64_t{extent.width} * extent.height * extent.depth *
                                 target.range().layerCount * texelBytes(target.format());
    if (bytes.size() != needed || needed == 0)
        throw AssertionError(fmt::format("uploading image '{}': {} bytes, needs {}", target.name(),
                                         bytes.size(), needed));
    const Buffer staging = makeStaging(commands, target.name(), bytes);
    commands.transition(target, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, true);
    commands.copyBufferToImage(staging, target);
    commands.transition(target, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

}  // namespace brume::gpu
