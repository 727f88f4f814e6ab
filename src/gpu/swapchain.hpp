// SPDX-License-Identifier: Apache-2.0
// The images that a window shows in turn, for programs that have a window of their own.
#pragma once

#include <gpu/image.hpp>

#include <vector>

namespace brume::gpu {

/// A surface and its swapchain, on a device made with DeviceOptions::windowExtensions. Drawing is
/// submitted and waited for between acquire() and present(), so that neither takes semaphores.
class Swapchain {
  public:
    /// Takes the surface over, also when it throws: a failure Error where the device cannot present
    /// to it. There are no images before resize().
    Swapchain(Device& device, VkSurfaceKHR surface);
    ~Swapchain();
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    /// Makes images for a window of that size, in pixels; waits for the device. Without area
    /// (minimised) there are none.
    void resize(VkExtent2D window);
    VkExtent2D extent() const { return mExtent; }
    VkFormat format() const { return mFormat.format; }  ///< 8 bits per channel, stored as they are

    /// The next image to draw into, its content undefined; null where the window has changed so
    /// that resize() is due, or has no area.
    const Image* acquire();
    /// Shows the acquired image, which must be in PRESENT_SRC. False where resize() is due.
    [[nodiscard]] bool present();

  private:
    struct Functions {
        PFN_vkDestroySurfaceKHR destroySurface = nullptr;
        PFN_vkGetPhysicalDeviceSurfaceSupportKHR getSupport = nullptr;
        PFN_vkGetPhysicalDeviceSurfaceCapabilitiesKHR getCapabilities = nullptr;
        PFN_vkGetPhysicalDeviceSurfaceFormatsKHR getFormats = nullptr;
    };
    void chooseFormat();
    void makeSwapchain(const VkSurfaceCapabilitiesKHR& capabilities);
    void makeImages();
    void destroyImages();

    Device* mDevice;
    VkSurfaceKHR mSurface;
    Functions mFunctions;
    VkSurfaceFormatKHR mFormat{};
    VkExtent2D mExtent{};
    VkSwapchainKHR mSwapchain = VK_NULL_HANDLE;
    VkFence mFence = VK_NULL_HANDLE;
    std::vector<Image> mImages;
    std::vector<VkImageView> mViews;
    std::uint32_t mIndex = 0;
};

}  // namespace brume::gpu
