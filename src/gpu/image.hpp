// SPDX-License-Identifier: Apache-2.0
// Named images with their own memory and view, and samplers.
#pragma once

#include <gpu/object_registry.hpp>

#include <string>

namespace brume::gpu {

/// Usages for ImageDesc, as a bit set.
enum ImageUsage : std::uint32_t {
    kUsageSampled = VK_IMAGE_USAGE_SAMPLED_BIT,
    kUsageStorage = VK_IMAGE_USAGE_STORAGE_BIT,
    kUsageColor = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
    kUsageDepth = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
    kUsageTransferRead = VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
    kUsageTransferWrite = VK_IMAGE_USAGE_TRANSFER_DST_BIT
};

struct ImageDesc {
    std::string name;
    VkFormat format = VK_FORMAT_UNDEFINED;
    std::uint32_t width = 1;
    std::uint32_t height = 1;
    std::uint32_t depth = 0;   ///< 0: a 2D image; else 3D with that depth
    std::uint32_t layers = 0;  ///< 0: not an array; else a 2D array (sampler2DArray, image2DArray)
    std::uint32_t usage = kUsageSampled | kUsageTransferWrite;  ///< of ImageUsage

    bool operator==(const ImageDesc&) const = default;
};

/// An existing image of the host, e.g. its colour or depth target.
struct HostImage {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;  ///< when Brume's commands begin
};

/// An image with one mip level, one sample and one view of all of it. Move-only; empty by default.
class Image {
  public:
    Image() = default;
    /// Throws a failure Error naming the image, its MiB and the limit that it breaks, or the usage
    /// that the device does not support for its format.
    Image(Device& device, const ImageDesc& desc);
    /// Wraps a host's image without owning it.
    Image(const ImageDesc& desc, const HostImage& host);

    const ImageDesc& desc() const { return mDesc; }
    const std::string& name() const { return mDesc.name; }
    VkFormat format() const { return mDesc.format; }
    VkExtent2D extent() const { return {mDesc.width, mDesc.height}; }
    VkExtent3D extent3d() const;
    std::uint64_t bytes() const { return mBytes; }  ///< of device memory; 0 for a host's
    VkImage handle() const { return mHandle; }
    VkImageView view() const { return mView; }
    VkImageAspectFlags aspect() const;
    VkImageSubresourceRange range() const;
    explicit operator bool() const { return mHandle != VK_NULL_HANDLE; }

    /// The layout after the commands recorded so far; Commands::transition() and the frame keep it.
    VkImageLayout layout() const { return mLayout; }
    void setLayout(VkImageLayout layout) const { mLayout = layout; }

    /// Makes a host's image stand for another one of the same description. Not for own images.
    void rebind(const HostImage& host) {
        mHandle = host.image;
        mView = host.view;
        mLayout = host.layout;
    }

  private:
    ImageDesc mDesc;
    std::uint64_t mBytes = 0;
    VkImage mHandle = VK_NULL_HANDLE;
    VkImageView mView = VK_NULL_HANDLE;
    mutable VkImageLayout mLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    ObjectOwner mOwner;
};

/// Bytes of one texel of an uncompressed colour or depth format; 0 for other formats.
std::uint32_t texelBytes(VkFormat format);
/// "r32g32b32a32_sfloat" and the like.
std::string formatName(VkFormat format);

enum class Filter { Nearest, Linear };
enum class AddressMode { ClampToEdge, Repeat, BorderZero };  ///< BorderZero: transparent black

struct SamplerDesc {
    std::string name;
    Filter filter = Filter::Linear;
    AddressMode addressX = AddressMode::ClampToEdge;
    AddressMode addressY = AddressMode::ClampToEdge;
    AddressMode addressZ = AddressMode::ClampToEdge;
};

class Sampler {
  public:
    Sampler() = default;
    Sampler(Device& device, const SamplerDesc& desc);
    const std::string& name() const { return mName; }
    VkSampler handle() const { return mHandle; }
    explicit operator bool() const { return static_cast<bool>(mOwner); }

  private:
    std::string mName;
    VkSampler mHandle = VK_NULL_HANDLE;
    ObjectOwner mOwner;
};

}  // namespace brume::gpu
