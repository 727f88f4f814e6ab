// SPDX-License-Identifier: Apache-2.0
// Limits and memory of a device.
#include <volk.h>
// volk.h goes first.
#include <fmt/format.h>
#include <gpu/instance.hpp>
#include <gpu/object_registry.hpp>

#include <algorithm>
#include <bit>

namespace brume::gpu {
namespace {

constexpr const char* kDoing = "allocating device memory";
double toMiB(std::uint64_t bytes) { return static_cast<double>(bytes) / (1024.0 * 1024.0); }

// What a memory type must have and what else is welcome.
struct Wishes {
    VkMemoryPropertyFlags required;
    VkMemoryPropertyFlags preferred;
};

Wishes wishesFor(MemoryKind kind) {
    constexpr VkMemoryPropertyFlags kMapped =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    switch (kind) {
        case MemoryKind::Upload:
            return {kMapped, 0};
        case MemoryKind::Readback:
            return {kMapped, VK_MEMORY_PROPERTY_HOST_CACHED_BIT};
        default:
            return {0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT};
    }
}

std::uint64_t largestDeviceHeap(const VkPhysicalDeviceMemoryProperties& memory) {
    std::uint64_t bytes = 0;
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i)
        if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)
            bytes = std::max<std::uint64_t>(bytes, memory.memoryHeaps[i].size);
    return bytes;
}

}  // namespace

void Device::readLimits() {
    VkPhysicalDeviceVulkan13Properties v13{};
    v13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_PROPERTIES;
    VkPhysicalDeviceVulkan11Properties v11{};
    v11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES;
    v11.pNext = &v13;
    VkPhysicalDevicePushDescriptorPropertiesKHR push{};
    push.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PUSH_DESCRIPTOR_PROPERTIES_KHR;
    push.pNext = &v11;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &push;
    mFunctions->getProperties(mPhysicalDevice, &properties);
    mFunctions->getMemoryProperties(mPhysicalDevice, &mMemory);
    mProperties = properties.properties;
    const VkPhysicalDeviceLimits& from = mProperties.limits;
    mLimits.maxStorageBufferRange = from.maxStorageBufferRange;
    mLimits.maxBufferBytes = v13.maxBufferSize;
    mLimits.maxAllocationBytes = v11.maxMemoryAllocationSize;
    mLimits.deviceHeapBytes = largestDeviceHeap(mMemory);
    mLimits.maxAllocations = from.maxMemoryAllocationCount;
    mLimits.maxImageDimension2d = from.maxImageDimension2D;
    mLimits.maxImageDimension3d = from.maxImageDimension3D;
    mLimits.maxImageLayers = from.maxImageArrayLayers;
    mLimits.maxPushConstantBytes = from.maxPushConstantsSize;
    mLimits.maxPushDescriptors = push.maxPushDescriptors;
    mLimits.maxGroupInvocations = from.maxComputeWorkGroupInvocations;
    std::copy_n(from.maxComputeWorkGroupCount, 3, mLimits.maxGroupCount);
    mLimits.maxSharedMemoryBytes = from.maxComputeSharedMemorySize;
    mLimits.subgroupSize = v11.subgroupSize;
    std::uint32_t count = 0;
    mFunctions->getQueueFamilies(mPhysicalDevice, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    mFunctions->getQueueFamilies(mPhysicalDevice, &count, families.data());
    mLimits.timestampValidBits = families.at(mQueueFamily).timestampValidBits;
    mLimits.timestampPeriodNs = from.timestampPeriod;
}

std::uint32_t Device::findMemoryType(std::uint32_t typeBits, MemoryKind kind) const {
    const Wishes wishes = wishesFor(kind);
    std::uint32_t best = ~0u;
    int bestScore = -1;
    for (std::uint32_t i = 0; i < mMemory.memoryTypeCount; ++i) {
        const VkMemoryPropertyFlags flags = mMemory.memoryTypes[i].propertyFlags;
        if (!(typeBits >> i & 1) || (flags & wishes.required) != wishes.required) continue;
        const int score = std::popcount(flags & wishes.preferred);
        if (score > bestScore) best = i, bestScore = score;
    }
    return best;
}

Allocation Device::allocate(const VkMemoryRequirements& needed, MemoryKind kind, bool hasAddress,
                            const std::string& object) {
    const std::uint32_t type = findMemoryType(needed.memoryTypeBits, kind);
    if (type == ~0u) throw failure(kDoing, object, "the device has no fitting memory type");
    const std::uint32_t heap = mMemory.memoryTypes[type].heapIndex;
    const std::uint64_t inUse = mRegistry->allocatedBytes(heap);
    const std::uint64_t heapBytes = mMemory.memoryHeaps[heap].size;
    const auto refuse = [&](const std::string& limit,
                            VkResult result = VK_ERROR_OUT_OF_DEVICE_MEMORY) {
        return VulkanError(
            failure(kDoing, object,
                    fmt::format("needs {:.1f} MiB, but {}", toMiB(needed.size), limit)),
            result);
    };
    const std::string heapText = fmt::format("the memory heap has {:.1f} MiB, {:.1f} MiB in use",
                                             toMiB(heapBytes), toMiB(inUse));
    if (needed.size > heapBytes || inUse > heapBytes - needed.size) throw refuse(heapText);
    const std::uint64_t allInUse = mRegistry->allocatedBytes();
    if (needed.size > mBudgetBytes || allInUse > mBudgetBytes - needed.size)
        throw refuse(fmt::format("the host's budget is {:.1f} MiB, {:.1f} MiB in use",
                                 toMiB(mBudgetBytes), toMiB(allInUse)));
    if (needed.size > mLimits.maxAllocationBytes)
        throw refuse(
            fmt::format("one allocation may have {:.1f} MiB", toMiB(mLimits.maxAllocationBytes)));
    if (mRegistry->allocations() >= mLimits.maxAllocations)
        throw refuse(fmt::format("all {} allocations are in use", mLimits.maxAllocations));
    VkMemoryAllocateFlagsInfo flags{};
    flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.pNext = hasAddress ? &flags : nullptr;
    info.allocationSize = needed.size;
    info.memoryTypeIndex = type;
    Allocation allocation{VK_NULL_HANDLE, needed.size, heap};
    const VkResult result =
        mMemoryHooks.allocate
            ? mMemoryHooks.allocate(mMemoryHooks.user, &info, &allocation.memory)
            : mTable->vkAllocateMemory(mDevice, &info, allocator(), &allocation.memory);
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY)
        throw refuse("the device is out of memory; " + heapText, result);
    check(result, kDoing, object);
    return allocation;
}

VkResult Device::imageLimits(const VkImageCreateInfo& info, VkImageFormatProperties& limits) const {
    return mFunctions->getImageFormat(mPhysicalDevice, info.format, info.imageType, info.tiling,
                                      info.usage, info.flags, &limits);
}

bool Device::canBlend(VkFormat format) const {
    VkFormatProperties properties{};
    mFunctions->getFormat(mPhysicalDevice, format, &properties);
    return (properties.optimalTilingFeatures & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT) != 0;
}

}  // namespace brume::gpu
