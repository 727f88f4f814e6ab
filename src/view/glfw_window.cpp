// SPDX-License-Identifier: Apache-2.0
// The only place with GLFW.
#include <core/error.hpp>
#include <gpu/swapchain.hpp>
#include <view/window.hpp>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include <optional>
#include <utility>

namespace brume::view {
namespace {

static_assert(kKeySpace == GLFW_KEY_SPACE && kKeyEscape == GLFW_KEY_ESCAPE &&
              kKeyTab == GLFW_KEY_TAB && kKeyRight == GLFW_KEY_RIGHT && kKeyLeft == GLFW_KEY_LEFT &&
              kKeyHome == GLFW_KEY_HOME && kKeyEnd == GLFW_KEY_END && kKeyF1 == GLFW_KEY_F1);

constexpr const char* kOpening = "opening a window";
constexpr double kIdleSeconds = 0.1;

std::string lastError() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "GLFW gives no reason";
}

class GlfwWindow : public Window {
  public:
    GlfwWindow(int width, int height, const std::string& title) {
        if (!glfwInit()) throw failure(kOpening, "", lastError());
        try {
            open(width, height, title);
        } catch (...) {
            glfwTerminate();
            throw;
        }
    }

    ~GlfwWindow() override {
        if (mDevice) ImGui_ImplGlfw_Shutdown();
        mSwapchain.reset();
        glfwDestroyWindow(mWindow);
        glfwTerminate();
    }

    std::vector<std::string> extensions() const override {
        std::uint32_t count = 0;
        const char** names = glfwGetRequiredInstanceExtensions(&count);
        return {names, names + count};
    }

    void attach(gpu::Device& device) override {
        VkSurfaceKHR surface = VK_NULL_HANDLE;
        if (glfwCreateWindowSurface(device.instance(), mWindow, nullptr, &surface) != VK_SUCCESS)
            throw failure(kOpening, device.info().name, lastError());
        mSwapchain.emplace(device, surface);
        // ImGui's own callbacks call these.
        glfwSetWindowUserPointer(mWindow, this);
        glfwSetKeyCallback(mWindow, &GlfwWindow::receiveKey);
        ImGui_ImplGlfw_InitForOther(mWindow, true);
        mDevice = &device;
        resize();
    }

    VkFormat format() const override { return mSwapchain->format(); }
    bool isOpen() const override { return !glfwWindowShouldClose(mWindow); }

    double poll(bool isBusy) override {
        if (isBusy)
            glfwPollEvents();
        else
            glfwWaitEventsTimeout(kIdleSeconds);
        ImGui_ImplGlfw_NewFrame();
        const double now = glfwGetTime(), passed = now - mLastTime;
        mLastTime = now;
        return passed;
    }

    std::vector<KeyPress> takeKeyPresses() override { return std::exchange(mPresses, {}); }

    double contentScale() const override {
        float x = 1, y = 1;
        glfwGetWindowContentScale(mWindow, &x, &y);
        // Where the window is measured in points, these are scaled already.
        int points = 0, ignored = 0;
        glfwGetWindowSize(mWindow, &points, &ignored);
        const std::uint32_t pixels = framebuffer().width;
        if (points < 1 || pixels < 1) return x;
        return static_cast<double>(x) * points / pixels;
    }

    void setTitle(const std::string& title) override {
        if (title == mTitle) return;
        mTitle = title;
        glfwSetWindowTitle(mWindow, title.c_str());
    }

    const gpu::Image* acquire() override {
        const VkExtent2D size = framebuffer();
        if (size.width != mSwapchain->extent().width || size.height != mSwapchain->extent().height)
            resize();
        const gpu::Image* image = mSwapchain->acquire();
        if (!image) resize();
        return image;
    }
    VkImageLayout presentLayout() const override { return VK_IMAGE_LAYOUT_PRESENT_SRC_KHR; }
    void present() override {
        if (!mSwapchain->present()) resize();
    }

  private:
    static void receiveKey(GLFWwindow* window, int key, int, int action, int modifiers) {
        if (action == GLFW_PRESS)
            static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window))
                ->mPresses.push_back({key, (modifiers & GLFW_MOD_CONTROL) != 0});
    }
    void open(int width, int height, const std::string& title) {
        if (!glfwVulkanSupported())
            throw failure(kOpening, "", "GLFW finds no Vulkan that could show images here");
        glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
        glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
        mWindow = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
        if (!mWindow) throw failure(kOpening, "", lastError());
        mTitle = title;
    }
    VkExtent2D framebuffer() const {
        int width = 0, height = 0;
        glfwGetFramebufferSize(mWindow, &width, &height);
        return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
    }
    void resize() { mSwapchain->resize(framebuffer()); }

    GLFWwindow* mWindow = nullptr;
    gpu::Device* mDevice = nullptr;
    std::optional<gpu::Swapchain> mSwapchain;
    std::string mTitle;
    std::vector<KeyPress> mPresses;
    double mLastTime = 0;
};

}  // namespace

std::unique_ptr<Window> openWindow(int width, int height, const std::string& title) {
    return std::make_unique<GlfwWindow>(width, height, title);
}

}  // namespace brume::view
