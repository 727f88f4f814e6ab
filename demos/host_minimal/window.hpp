// SPDX-License-Identifier: Apache-2.0
// A window of fixed size for the renderer's colours; knows nothing of Brume.
#pragma once

#include "renderer.hpp"

struct GLFWwindow;

namespace host_minimal {

class Window {
  public:
    Window(std::uint32_t width, std::uint32_t height, const char* title);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Instance extensions that the renderer must have.
    std::vector<const char*> extensions() const;
    void attach(const Renderer& renderer);
    void detach(const Renderer& renderer);  ///< once the device is idle, before the renderer goes

    bool isOpen() const;
    double seconds() const;

    /// Copies the colours, which are in COLOR_ATTACHMENT_OPTIMAL, to the window, ends the frame and
    /// shows it.
    void present(Renderer& renderer, VkCommandBuffer commands);

  private:
    void createSwapchain(const Renderer& renderer);

    GLFWwindow* mWindow = nullptr;
    VkSurfaceKHR mSurface = VK_NULL_HANDLE;
    VkSwapchainKHR mSwapchain = VK_NULL_HANDLE;
    std::vector<VkImage> mImages;
    std::vector<VkSemaphore> mDrawn;  // by image
    VkSemaphore mAcquired[Renderer::kFramesInFlight] = {};
};

}  // namespace host_minimal
