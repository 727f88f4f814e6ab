// SPDX-License-Identifier: Apache-2.0
#include "window.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>

namespace host_minimal {
namespace {

void check(VkResult result, const char* doing) {
    if (result != VK_SUCCESS && result != VK_SUBOPTIMAL_KHR)
        throw std::runtime_error(std::string(doing) + ": VkResult " + std::to_string(result));
}

VkSemaphore createSemaphore(const Renderer& renderer) {
    const VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    VkSemaphore semaphore = VK_NULL_HANDLE;
    check(vkCreateSemaphore(renderer.device, &info, nullptr, &semaphore), "creating semaphore");
    return semaphore;
}

}  // namespace

Window::Window(std::uint32_t width, std::uint32_t height, const char* title) {
    if (!glfwInit() || !glfwVulkanSupported())
        throw std::runtime_error("opening a window: there is no screen with Vulkan");
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_RESIZABLE, GLFW_FALSE);
    mWindow = glfwCreateWindow(static_cast<int>(width), static_cast<int>(height), title, nullptr,
                               nullptr);
    if (!mWindow) throw std::runtime_error("opening a window failed");
}

Window::~Window() {
    glfwDestroyWindow(mWindow);
    glfwTerminate();
}

std::vector<const char*> Window::extensions() const {
    std::uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    return {names, names + count};
}

void Window::attach(const Renderer& renderer) {
    check(glfwCreateWindowSurface(renderer.instance, mWindow, nullptr, &mSurface),
          "creating surface");
    VkBool32 isSupported = VK_FALSE;
    vkGetPhysicalDeviceSurfaceSupportKHR(renderer.physicalDevice, renderer.queueFamily, mSurface,
                                         &isSupported);
    if (!isSupported) throw std::runtime_error("the device cannot show images in this window");
    createSwapchain(renderer);
    for (VkSemaphore& semaphore : mAcquired) semaphore = createSemaphore(renderer);
    for (std::size_t i = 0; i < mImages.size(); ++i) mDrawn.push_back(createSemaphore(renderer));
}

void Window::createSwapchain(const Renderer& renderer) {
    VkSurfaceCapabilitiesKHR capabilities{};
    check(
        vkGetPhysicalDeviceSurfaceCapabilitiesKHR(renderer.physicalDevice, mSurface, &capabilities),
        "reading surface");
    std::uint32_t count = 0;
    vkGetPhysicalDeviceSurfaceFormatsKHR(renderer.physicalDevice, mSurface, &count, nullptr);
    std::vector<VkSurfaceFormatKHR> formats(count);
    vkGetPhysicalDeviceSurfaceFormatsKHR(renderer.physicalDevice, mSurface, &count, formats.data());
    // Colours are sRGB on both sides of the copy.
    const auto isSrgb = [](const VkSurfaceFormatKHR& format) {
        return format.format == VK_FORMAT_B8G8R8A8_SRGB || format.format == VK_FORMAT_R8G8B8A8_SRGB;
    };
    const auto format = std::find_if(formats.begin(), formats.end(), isSrgb);
    if (format == formats.end()) throw std::runtime_error("the window takes no sRGB images");
    VkSwapchainCreateInfoKHR info{VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
    info.surface = mSurface;
    info.minImageCount = capabilities.minImageCount;
    info.imageFormat = format->format;
    info.imageColorSpace = format->colorSpace;
    info.imageExtent = capabilities.currentExtent;
    info.imageArrayLayers = 1;
    info.imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    info.preTransform = capabilities.currentTransform;
    info.compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
    info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
    info.clipped = VK_TRUE;
    check(vkCreateSwapchainKHR(renderer.device, &info, nullptr, &mSwapchain), "creating swapchain");
    vkGetSwapchainImagesKHR(renderer.device, mSwapchain, &count, nullptr);
    mImages.resize(count);
    check(vkGetSwapchainImagesKHR(renderer.device, mSwapchain, &count, mImages.data()),
          "reading swapchain");
}

void Window::detach(const Renderer& renderer) {
    for (const VkSemaphore semaphore : mAcquired)
        vkDestroySemaphore(renderer.device, semaphore, nullptr);
    for (const VkSemaphore semaphore : mDrawn)
        vkDestroySemaphore(renderer.device, semaphore, nullptr);
    vkDestroySwapchainKHR(renderer.device, mSwapchain, nullptr);
    vkDestroySurfaceKHR(renderer.instance, mSurface, nullptr);
}

bool Window::isOpen() const {
    glfwPollEvents();
    return !glfwWindowShouldClose(mWindow);
}

double Window::seconds() const { return glfwGetTime(); }

void Window::present(Renderer& renderer, VkCommandBuffer commands) {
    const VkSemaphore acquired = mAcquired[renderer.slot()];
    std::uint32_t index = 0;
    check(vkAcquireNextImageKHR(renderer.device, mSwapchain, UINT64_MAX, acquired, VK_NULL_HANDLE,
                                &index),
          "acquiring image");
    barrier(commands, renderer.color.image, VK_IMAGE_ASPECT_COLOR_BIT,
            VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    barrier(commands, mImages[index], VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
            VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    VkImageBlit region{};
    region.srcSubresource = region.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.srcOffsets[1] = region.dstOffsets[1] = {static_cast<std::int32_t>(renderer.width),
                                                   static_cast<std::int32_t>(renderer.height), 1};
    vkCmdBlitImage(commands, renderer.color.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                   mImages[index], VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region,
                   VK_FILTER_NEAREST);
    barrier(commands, mImages[index], VK_IMAGE_ASPECT_COLOR_BIT,
            VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
    renderer.endFrame(acquired, mDrawn[index]);
    VkPresentInfoKHR info{VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &mDrawn[index];
    info.swapchainCount = 1;
    info.pSwapchains = &mSwapchain;
    info.pImageIndices = &index;
    check(vkQueuePresentKHR(renderer.queue, &info), "presenting image");
}

}  // namespace host_minimal
