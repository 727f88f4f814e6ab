// SPDX-License-Identifier: Apache-2.0
#include <volk.h>
// volk.h goes first.
#include <gpu/instance.hpp>
#include <gpu/swapchain.hpp>

#include <algorithm>

namespace brume::gpu {
namespace {

constexpr const char* kCreating = "creating swapchain";

template <typename Function>
void loadInto(Function& function, VkInstance instance, const char* name) {
    function = reinterpret_cast<Function>(systemLoader()(instance, name));
}

}  // namespace

Swapchain::Swapchain(Device& device, VkSurfaceKHR surface) : mDevice(&device), mSurface(surface) {
    loadInto(mFunctions.destroySurface, device.instance(), "vkDestroySurfaceKHR");
    loadInto(mFunctions.getSupport, device.instance(), "vkGetPhysicalDeviceSurfaceSupportKHR");
    loadInto(mFunctions.getCapabilities, device.instance(),
             "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
    loadInto(mFunctions.getFormats, device.instance(), "vkGetPhysicalDeviceSurfaceFormatsKHR");
    try {
        VkBool32 isSupported = VK_FALSE;
        device.check(mFunctions.getSupport(device.physicalDevice(), device.queueFamily(), surface,
                                           &isSupported),
                     kCreating, "surface");
        if (!isSupported)
            throw failure(kCreating, device.info().name,
                          "its queue cannot show images in this window, choose another device");
        chooseFormat();
        VkFenceCreateInfo fence{};
        fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
        device.check(device.vk().vkCreateFence(device.handle(), &fence, nullptr, &mFence),
                     kCreating, "fence");
    } catch (...) {
        mFunctions.destroySurface(device.instance(), surface, nullptr);
        throw;
    }
}

Swapchain::~Swapchain() {
    const VolkDeviceTable& vk = mDevice->vk();
    vk.vkDeviceWaitIdle(mDevice->handle());
    destroyImages();
    vk.vkDestroySwapchainKHR(mDevice->handle(), mSwapchain, nullptr);
    vk.vkDestroyFence(mDevice->handle(), mFence, nullptr);
    mFunctions.destroySurface(mDevice->instance(), mSurface, nullptr);
}

void Swapchain::chooseFormat() {
    std::uint32_t count = 0;
    mFunctions.getFormats(mDevice->physicalDevice(), mSurface, &count, nullptr);
    std::vector<VkSurfaceFormatKHR> formats(count);
    mDevice->check(
        mFunctions.getFormats(mDevice->physicalDevice(), mSurface, &count, formats.data()),
        kCreating, "formats");
    for (const VkSurfaceFormatKHR& format : formats)
        for (const VkFormat wanted : {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM})
            if (format.format == wanted && mFormat.format == VK_FORMAT_UNDEFINED) mFormat = format;
    if (mFormat.format == VK_FORMAT_UNDEFINED)
        throw failure(kCreating, mDevice->info().name,
                      "the window takes no images with 8 bits per channel");
}

void Swapchain::resize(VkExtent2D window) {
    mDevice->vk().vkDeviceWaitIdle(mDevice->handle());
    destroyImages();
    VkSurfaceCapabilitiesKHR capabilities{};
    mDevice->check(
        mFunctions.getCapabilities(mDevice->physicalDevice(), mSurface, &capabilities), kCreating,
        "capabilities");
    // Some window systems leave the size to the images.
    mExtent = capabilities.currentExtent.width != ~0u ? capabilities.currentExtent : window;
    mExtent.width = std::clamp(mExtent.width, capabilities.minImageExtent.width,
                               capabilities.maxImageExtent.width);
    mExtent.height = std::clamp(mExtent.height, capabilities.minImageExtent.height,
                                capabilities.maxImageExtent.height);
    if (window.width == 0 || window.height == 0) mExtent = {};
    if (mExtent.width == 0 || mExtent.height == 0) return;
    makeSwapchain(capabilities);
    makeImages();
}

void Swapchain::makeSwapchain(const VkSurfaceCapabilitiesKHR& capabilities) {
    const VkSwapchainKHR old = mSwapchain;
    VkSwapchainCreateInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR;
    info.surface = mSurface;
    info.minImageCount = capabilities.minImageCount + 1;
    if (capabilities.maxImageCount > 0)
        info.minImageCount = std::min(info.minImageCount, capabilities.maxImageCount);
    info.imageFormat = mFormat.format;
    info.imageColorSpace = mFormat.colorSpace;
    info.imageExtent = mExtent;
    info.imageArrayLayers = 1;
    info.imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.preTransform = capabilities.currentTransform;
    info.compositeAlpha =
        capabilities.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
            ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
            : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
    info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
    info.clipped = VK_TRUE;
    info.oldSwapchain = old;
    mSwapchain = VK_NULL_HANDLE;
    const VkResult result =
        mDevice->vk().vkCreateSwapchainKHR(mDevice->handle(), &info, nullptr, &mSwapchain);
    mDevice->vk().vkDestroySwapchainKHR(mDevice->handle(), old, nullptr);
    mDevice->check(result, kCreating, "swapchain");
}

void Swapchain::makeImages() {
    const VolkDeviceTable& vk = mDevice->vk();
    std::uint32_t count = 0;
    vk.vkGetSwapchainImagesKHR(mDevice->handle(), mSwapchain, &count, nullptr);
    std::vector<VkImage> handles(count);
    mDevice->check(
        vk.vkGetSwapchainImagesKHR(mDevice->handle(), mSwapchain, &count, handles.data()),
        kCreating, "images");
    for (const VkImage handle : handles) {
        VkImageViewCreateInfo view{};
        view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
        view.image = handle;
        view.viewType = VK_IMAGE_VIEW_TYPE_2D;
        view.format = mFormat.format;
        view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        mViews.push_back(VK_NULL_HANDLE);
        mDevice->check(vk.vkCreateImageView(mDevice->handle(), &view, nullptr, &mViews.back()),
                       kCreating, "view");
        mImages.emplace_back(ImageDesc{.name = "window",
                                       .format = mFormat.format,
                                       .width = mExtent.width,
                                       .height = mExtent.height,
                                       .usage = kUsageColor},
                             HostImage{handle, mViews.back(), VK_IMAGE_LAYOUT_UNDEFINED});
    }
}

void Swapchain::destroyImages() {
    mImages.clear();
    for (const VkImageView view : mViews)
        mDevice->vk().vkDestroyImageView(mDevice->handle(), view, nullptr);
    mViews.clear();
}

const Image* Swapchain::acquire() {
    if (mImages.empty()) return nullptr;
    const VolkDeviceTable& vk = mDevice->vk();
    const VkResult result = vk.vkAcquireNextImageKHR(mDevice->handle(), mSwapchain, UINT64_MAX,
                                                     VK_NULL_HANDLE, mFence, &mIndex);
    if (result == VK_ERROR_OUT_OF_DATE_KHR) return nullptr;
    // One that no longer fits well is still shown; present() then says so.
    if (result != VK_SUBOPTIMAL_KHR) mDevice->check(result, "acquiring", "window image");
    mDevice->check(vk.vkWaitForFences(mDevice->handle(), 1, &mFence, VK_TRUE, UINT64_MAX),
                   "waiting for", "window image");
    mDevice->check(vk.vkResetFences(mDevice->handle(), 1, &mFence), "waiting for", "window image");
    mImages[mIndex].setLayout(VK_IMAGE_LAYOUT_UNDEFINED);
    return &mImages[mIndex];
}

bool Swapchain::present() {
    VkPresentInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR;
    info.swapchainCount = 1;
    info.pSwapchains = &mSwapchain;
    info.pImageIndices = &mIndex;
    const VkResult result = mDevice->vk().vkQueuePresentKHR(mDevice->queue(), &info);
    if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR) return false;
    mDevice->check(result, "presenting", "window image");
    return true;
}

}  // namespace brume::gpu
