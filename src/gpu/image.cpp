// SPDX-License-Identifier: Apache-2.0
#include <volk.h>
// volk.h goes first.
#include <fmt/format.h>
#include <core/assert.hpp>
#include <gpu/image.hpp>

#include <algorithm>

namespace brume::gpu {
namespace {

constexpr const char* kDoing = "creating image";

struct FormatInfo {
    VkFormat format;
    std::uint32_t bytes;
    const char* name;
};

constexpr FormatInfo kFormats[] = {{VK_FORMAT_R8_UNORM, 1, "r8_unorm"},
                                   {VK_FORMAT_R8_UINT, 1, "r8_uint"},
                                   {VK_FORMAT_R8G8_UNORM, 2, "r8g8_unorm"},
                                   {VK_FORMAT_R8G8_SNORM, 2, "r8g8_snorm"},
                                   {VK_FORMAT_R8G8B8A8_UNORM, 4, "r8g8b8a8_unorm"},
                                   {VK_FORMAT_R8G8B8A8_SRGB, 4, "r8g8b8a8_srgb"},
                                   {VK_FORMAT_B8G8R8A8_UNORM, 4, "b8g8r8a8_unorm"},
                                   {VK_FORMAT_B8G8R8A8_SRGB, 4, "b8g8r8a8_srgb"},
                                   {VK_FORMAT_A2B10G10R10_UNORM_PACK32, 4, "a2b10g10r10_unorm"},
                                   {VK_FORMAT_B10G11R11_UFLOAT_PACK32, 4, "b10g11r11_ufloat"},
                                   {VK_FORMAT_E5B9G9R9_UFLOAT_PACK32, 4, "e5b9g9r9_ufloat"},
                                   {VK_FORMAT_R16_UNORM, 2, "r16_unorm"},
                                   {VK_FORMAT_R16_UINT, 2, "r16_uint"},
                                   {VK_FORMAT_R16_SFLOAT, 2, "r16_sfloat"},
                                   {VK_FORMAT_R16G16_UNORM, 4, "r16g16_unorm"},
                                   {VK_FORMAT_R16G16_SFLOAT, 4, "r16g16_sfloat"},
                                   {VK_FORMAT_R16G16B16A16_UNORM, 8, "r16g16b16a16_unorm"},
                                   {VK_FORMAT_R16G16B16A16_SFLOAT, 8, "r16g16b16a16_sfloat"},
                                   {VK_FORMAT_R32_UINT, 4, "r32_uint"},
                                   {VK_FORMAT_R32_SINT, 4, "r32_sint"},
                                   {VK_FORMAT_R32_SFLOAT, 4, "r32_sfloat"},
                                   {VK_FORMAT_R32G32_UINT, 8, "r32g32_uint"},
                                   {VK_FORMAT_R32G32_SFLOAT, 8, "r32g32_sfloat"},
                                   {VK_FORMAT_R32G32B32A32_UINT, 16, "r32g32b32a32_uint"},
                                   {VK_FORMAT_R32G32B32A32_SFLOAT, 16, "r32g32b32a32_sfloat"},
                                   {VK_FORMAT_D16_UNORM, 2, "d16_unorm"},
                                   {VK_FORMAT_D32_SFLOAT, 4, "d32_sfloat"}};

const FormatInfo* findFormat(VkFormat format) {
    const auto* found = std::find_if(std::begin(kFormats), std::end(kFormats),
                                     [=](const FormatInfo& f) { return f.format == format; });
    return found == std::end(kFormats) ? nullptr : found;
}

VkImageCreateInfo createInfo(const ImageDesc& desc) {
    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = desc.depth > 0 ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D;
    info.format = desc.format;
    info.extent = {desc.width, desc.height, std::max(desc.depth, 1u)};
    info.mipLevels = 1;
    info.arrayLayers = std::max(desc.layers, 1u);
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = desc.usage;
    return info;
}

void checkDesc(const Device& device, const ImageDesc& desc, const VkImageCreateInfo& info) {
    if (desc.name.empty()) throw AssertionError("creating image: it has no name");
    if (desc.usage == 0 || (desc.depth > 0 && desc.layers > 0))
        throw AssertionError(fmt::format("image '{}': no usage, or both 3D and array", desc.name));
    if (desc.width == 0 || desc.height == 0)
        throw failure(kDoing, desc.name, "its size is 0, needs at least 1");
    VkImageFormatProperties limits{};
    const VkResult result = device.imageLimits(info, limits);
    if (result == VK_ERROR_FORMAT_NOT_SUPPORTED)
        throw failure(kDoing, desc.name,
                      fmt::format("{} does not support format {} with usage {:#x}",
                                  device.info().name, formatName(desc.format), desc.usage));
    device.check(result, kDoing, desc.name);
    const VkExtent3D& most = limits.maxExtent;
    if (info.extent.width > most.width || info.extent.height > most.height ||
        info.extent.depth > most.depth || info.arrayLayers > limits.maxArrayLayers)
        throw failure(kDoing, desc.name,
                      fmt::format("{}x{}x{} with {} layers, but {} allows {}x{}x{} with {}",
                                  info.extent.width, info.extent.height, info.extent.depth,
                                  info.arrayLayers, device.info().name, most.width, most.height,
                                  most.depth, limits.maxArrayLayers));
}

VkImageViewType viewType(const ImageDesc& desc) {
    if (desc.depth > 0) return VK_IMAGE_VIEW_TYPE_3D;
    return desc.layers > 0 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
}

VkSamplerAddressMode toVulkan(AddressMode mode) {
    switch (mode) {
        case AddressMode::Repeat:
            return VK_SAMPLER_ADDRESS_MODE_REPEAT;
        case AddressMode::BorderZero:
            return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER;
        default:
            return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    }
}

}  // namespace

std::uint32_t texelBytes(VkFormat format) {
    const FormatInfo* info = findFormat(format);
    return info ? info->bytes : 0;
}

std::string formatName(VkFormat format) {
    const FormatInfo* info = findFormat(format);
    return info ? info->name : fmt::format("format {}", static_cast<int>(format));
}

Image::Image(Device& device, const ImageDesc& desc) : mDesc(desc) {
    const VkImageCreateInfo info = createInfo(desc);
    checkDesc(device, desc, info);
    const VolkDeviceTable& vk = device.vk();
    mOwner = ObjectOwner(device, "image", desc.name);
    device.check(vk.vkCreateImage(device.handle(), &info, device.allocator(), &mHandle), kDoing, desc.name);
    mOwner.add(owned(VK_OBJECT_TYPE_IMAGE, mHandle));
    device.setName(VK_OBJECT_TYPE_IMAGE, (std::uint64_t)mHandle, desc.name);
    VkMemoryRequirements needed{};
    vk.vkGetImageMemoryRequirements(device.handle(), mHandle, &needed);
    const Allocation allocation = device.allocate(needed, MemoryKind::Device, false, desc.name);
    mBytes = allocation.bytes;
    mOwner.add(allocation, MemoryKind::Device);
    device.check(vk.vkBindImageMemory(device.handle(), mHandle, allocation.memory, 0), kDoing,
                 desc.name);
    constexpr std::uint32_t kNeedsView = kUsageSampled | kUsageStorage | kUsageColor | kUsageDepth;
    if (!(desc.usage & kNeedsView)) return;
    VkImageViewCreateInfo view{};
    view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    view.image = mHandle;
    view.viewType = viewType(desc);
    view.format = desc.format;
    view.subresourceRange = range();
    device.check(vk.vkCreateImageView(device.handle(), &view, device.allocator(), &mView), kDoing, desc.name);
    mOwner.add(owned(VK_OBJECT_TYPE_IMAGE_VIEW, mView));
    device.setName(VK_OBJECT_TYPE_IMAGE_VIEW, (std::uint64_t)mView, desc.name);
}

Image::Image(const ImageDesc& desc, const HostImage& host)
    : mDesc(desc), mHandle(host.image), mView(host.view), mLayout(host.layout) {}

VkExtent3D Image::extent3d() const {
    return {mDesc.width, mDesc.height, std::max(mDesc.depth, 1u)};
}

VkImageAspectFlags Image::aspect() const {
    switch (mDesc.format) {
        case VK_FORMAT_D16_UNORM:
        case VK_FORMAT_X8_D24_UNORM_PACK32:
        case VK_FORMAT_D32_SFLOAT:
            return VK_IMAGE_ASPECT_DEPTH_BIT;
        case VK_FORMAT_D16_UNORM_S8_UINT:
        case VK_FORMAT_D24_UNORM_S8_UINT:
        case VK_FORMAT_D32_SFLOAT_S8_UINT:
            return VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;
        default:
            return VK_IMAGE_ASPECT_COLOR_BIT;
    }
}

VkImageSubresourceRange Image::range() const {
    return {aspect(), 0, 1, 0, std::max(mDesc.layers, 1u)};
}

Sampler::Sampler(Device& device, const SamplerDesc& desc) : mName(desc.name) {
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.magFilter = desc.filter == Filter::Linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
    info.minFilter = info.magFilter;
    info.addressModeU = toVulkan(desc.addressX);
    info.addressModeV = toVulkan(desc.addressY);
    info.addressModeW = toVulkan(desc.addressZ);
    info.borderColor = VK_BORDER_COLOR_FLOAT_TRANSPARENT_BLACK;
    mOwner = ObjectOwner(device, "sampler", mName);
    device.check(device.vk().vkCreateSampler(device.handle(), &info, device.allocator(), &mHandle),
                 "creating sampler", mName);
    mOwner.add(owned(VK_OBJECT_TYPE_SAMPLER, mHandle));
    device.setName(VK_OBJECT_TYPE_SAMPLER, (std::uint64_t)mHandle, mName);
}

}  // namespace brume::gpu
