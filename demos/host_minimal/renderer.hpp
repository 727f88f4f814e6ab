// SPDX-License-Identifier: Apache-2.0
// A renderer that knows nothing of Brume: it draws a spinning cube on a floor into images of its
// own. Depth is reversed and infinite, colours are sRGB, two frames are in flight.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace host_minimal {

struct Image {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkFormat format = VK_FORMAT_UNDEFINED;
};

/// Records the change of an image's layout, ordered after all before and before all that follows.
void barrier(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect, VkImageLayout from,
             VkImageLayout to);

class Renderer {
  public:
    /// `validate`: with the Khronos validation layer and synchronization validation.
    /// `windowExtensions`: of the instance, for a window to show the images; may be empty.
    Renderer(std::uint32_t width, std::uint32_t height, bool validate,
             const std::vector<const char*>& windowExtensions = {});
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Waits for the frame before the last one and begins to record.
    VkCommandBuffer beginFrame();
    /// Draws everything opaque; leaves the colours in COLOR_ATTACHMENT_OPTIMAL and the depths in
    /// DEPTH_ATTACHMENT_OPTIMAL.
    void drawOpaque(VkCommandBuffer commands, double seconds);
    /// Submits; waits for and signals these semaphores (none: null).
    void endFrame(VkSemaphore wait = VK_NULL_HANDLE, VkSemaphore signal = VK_NULL_HANDLE);
    std::uint32_t slot() const { return mFrame % kFramesInFlight; }  ///< of the frame that is recorded
    void waitIdle() { vkDeviceWaitIdle(device); }

    /// Writes the colours of the last frame.
    void writePng(const std::string& file);

    /// Messages of the validation layer so far.
    const std::vector<std::string>& messages() const { return mMessages; }

    static constexpr std::uint32_t kFramesInFlight = 2;
    std::uint32_t width, height;
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    std::uint32_t queueFamily = 0;
    VkQueue queue = VK_NULL_HANDLE;
    bool hasFloat64 = false;  ///< the feature shaderFloat64 is enabled
    Image color, depth;
    /// Column-major, for view space with y up and -z ahead.
    double viewFromWorld[16] = {}, clipFromView[16] = {};

  private:
    struct Frame {
        VkCommandBuffer commands = VK_NULL_HANDLE;
        VkFence fence = VK_NULL_HANDLE;
    };
    void createInstance(bool validate, std::vector<const char*> extensions);
    void createDevice(bool hasWindow);
    void createFrames();
    void createPipeline();
    void setCamera();
    Image createImage(VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect);
    std::uint32_t findMemory(std::uint32_t types, VkMemoryPropertyFlags flags) const;

    VkDebugUtilsMessengerEXT mMessenger = VK_NULL_HANDLE;
    std::vector<std::string> mMessages;
    VkCommandPool mPool = VK_NULL_HANDLE;
    Frame mFrames[kFramesInFlight];
    std::uint32_t mFrame = 0;
    VkPipelineLayout mLayout = VK_NULL_HANDLE;
    VkPipeline mPipeline = VK_NULL_HANDLE;
};

}  // namespace host_minimal
