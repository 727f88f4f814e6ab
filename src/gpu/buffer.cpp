// SPDX-License-Identifier: Apache-2.0
#include <volk.h>
// volk.h goes first.
#include <fmt/format.h>
#include <core/assert.hpp>
#include <gpu/buffer.hpp>

#include <cstring>

namespace brume::gpu {
namespace {

constexpr const char* kDoing = "creating buffer";
constexpr VkBufferUsageFlags kUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
    VK_BUFFER_USAGE_INDEX_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
    VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
    VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;

void checkDesc(const Device& device, const BufferDesc& desc) {
    if (desc.name.empty()) throw AssertionError("creating buffer: it has no name");
    if (desc.bytes == 0) throw failure(kDoing, desc.name, "it has 0 bytes, needs at least 1");
    if (desc.bytes <= device.limits().maxBufferBytes) return;
    constexpr double kMiB = 1024.0 * 1024.0;
    throw failure(kDoing, desc.name,
                  fmt::format("needs {:.1f} MiB, but a buffer of {} may have {:.1f} MiB and the "
                              "device's memory is {:.1f} MiB",
                              static_cast<double>(desc.bytes) / kMiB, device.info().name,
                              static_cast<double>(device.limits().maxBufferBytes) / kMiB,
                              static_cast<double>(device.limits().deviceHeapBytes) / kMiB));
}

}  // namespace

Buffer::Buffer(Device& device, const BufferDesc& desc) : mName(desc.name), mBytes(desc.bytes) {
    checkDesc(device, desc);
    const VolkDeviceTable& vk = device.vk();
    mOwner = ObjectOwner(device, "buffer", mName);
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = mBytes;
    info.usage = kUsage;
    device.check(vk.vkCreateBuffer(device.handle(), &info, device.allocator(), &mHandle), kDoing, mName);
    mOwner.add(owned(VK_OBJECT_TYPE_BUFFER, mHandle));
    device.setName(VK_OBJECT_TYPE_BUFFER, (std::uint64_t)mHandle, mName);
    VkMemoryRequirements needed{};
    vk.vkGetBufferMemoryRequirements(device.handle(), mHandle, &needed);
    const Allocation allocation = device.allocate(needed, desc.memory, true, mName);
    mOwner.add(allocation, desc.memory);
    device.check(vk.vkBindBufferMemory(device.handle(), mHandle, allocation.memory, 0), kDoing,
                 mName);
    if (desc.memory != MemoryKind::Device)
        device.check(
            vk.vkMapMemory(device.handle(), allocation.memory, 0, VK_WHOLE_SIZE, 0, &mMapped),
            "mapping buffer", mName);
    // Counters are asked for before the first frame has finished, too.
    if (desc.memory == MemoryKind::Readback) std::memset(mMapped, 0, mBytes);
    VkBufferDeviceAddressInfo address{};
    address.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO;
    address.buffer = mHandle;
    mAddress = vk.vkGetBufferDeviceAddress(device.handle(), &address);
}

void* Buffer::requireMapped() const {
    if (!mMapped) throw AssertionError(fmt::format("buffer '{}' is not mapped", mName));
    return mMapped;
}

}  // namespace brume::gpu
