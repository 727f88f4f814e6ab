// SPDX-License-Identifier: Apache-2.0
#include <view/window.hpp>

#include <imgui.h>

#include <chrono>
#include <thread>

namespace brume::view {
namespace {

constexpr double kSecondsPerPicture = 1 / 24.0;
constexpr std::chrono::milliseconds kIdle(5);

class OffscreenWindow : public Window {
  public:
    OffscreenWindow(int width, int height) : mWidth(width), mHeight(height) {}

    std::vector<std::string> extensions() const override { return {}; }
    void attach(gpu::Device& device) override {
        mImage = gpu::Image(device, {.name = "window",
                                     .format = format(),
                                     .width = static_cast<std::uint32_t>(mWidth),
                                     .height = static_cast<std::uint32_t>(mHeight),
                                     .usage = gpu::kUsageColor});
    }
    VkFormat format() const override { return VK_FORMAT_R8G8B8A8_UNORM; }
    bool isOpen() const override { return true; }  // a script ends it
    double poll(bool isBusy) override {
        if (!isBusy) std::this_thread::sleep_for(kIdle);
        ImGuiIO& io = ImGui::GetIO();
        io.DisplaySize = {static_cast<float>(mWidth), static_cast<float>(mHeight)};
        io.DeltaTime = static_cast<float>(kSecondsPerPicture);
        return kSecondsPerPicture;
    }
    std::vector<KeyPress> takeKeyPresses() override { return {}; }
    double contentScale() const override { return 1; }
    void setTitle(const std::string&) override {}
    const gpu::Image* acquire() override { return &mImage; }
    VkImageLayout presentLayout() const override {
        return VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    }
    void present() override {}

  private:
    int mWidth, mHeight;
    gpu::Image mImage;
};

}  // namespace

std::unique_ptr<Window> makeOffscreenWindow(int width, int height) {
    return std::make_unique<OffscreenWindow>(width, height);
}

}  // namespace brume::view
