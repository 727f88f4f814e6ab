// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <core/image_io.hpp>
#include <gpu/submitter.hpp>
#include <view/panels/panels.hpp>
#include <view/script.hpp>
#include <view/viewer.hpp>
#include <view/window.hpp>

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <optional>

namespace brume::view {
namespace {

class ImGuiContextScope {
  public:
    ImGuiContextScope() {
        ImGui::CreateContext();
        ImGui::GetIO().IniFilename = nullptr;  // it would lie about in the user's folder
    }
    ~ImGuiContextScope() { ImGui::DestroyContext(); }
    ImGuiContextScope(const ImGuiContextScope&) = delete;
    ImGuiContextScope& operator=(const ImGuiContextScope&) = delete;
};

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus;

/// A part of the window at a fixed place.
void beginPart(const char* name, ImVec2 at, ImVec2 size, bool isPadded) {
    ImGui::SetNextWindowPos(at);
    ImGui::SetNextWindowSize(size);
    if (!isPadded) ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::Begin(name, nullptr,
                 isPadded ? kFixed : kFixed | ImGuiWindowFlags_NoScrollbar |
                                         ImGuiWindowFlags_NoScrollWithMouse);
    if (!isPadded) ImGui::PopStyleVar();
}

class Viewer {
  public:
    Viewer(const ViewerOptions& options, const Log& log)
        : mWindow(options.isOffscreen ? makeOffscreenWindow(options.width, options.height)
                                      : openWindow(options.width, options.height, "brume")),
          mDevice(makeDevice(options, log)),
          mSubmitter(*mDevice),
          mStage(*mDevice, log, options.scene) {
        if (!options.shaders.empty()) mStage.watchShaders(options.shaders);
        if (!options.script.empty()) mScript.emplace(options.script);
        setStyle(mWindow->contentScale());
        mWindow->attach(*mDevice);
        mUi.emplace(mSubmitter, mWindow->format());
        choose(options);
    }

    void run() {
        bool mustEnd = false;
        while (mWindow->isOpen() && !mustEnd) mustEnd = showFrame();
    }

    const gpu::Device& device() const { return *mDevice; }

  private:
    std::unique_ptr<gpu::Device> makeDevice(const ViewerOptions& options, const Log& log) const {
        gpu::DeviceOptions device = options.device;
        device.windowExtensions = mWindow->extensions();
        return gpu::Device::create(device, log);
    }

    void choose(const ViewerOptions& options) {
        PaneChoice& choice = mStage.choices[0];
        if (!options.method.empty() && options.method != choice.method)
            choice = {options.method, {}, ""};
        for (const auto& [key, value] : options.settings) choice.settings[key] = value;
        for (PaneChoice& each : mStage.choices) each.shadow = options.shadow;
    }

    /// Whether it was the last one.
    bool showFrame() {
        const double seconds = mWindow->poll(mStage.isBusy());
        const ScriptInput input = mScript ? mScript->step(mStage) : ScriptInput();
        applyInput(input);
        ImGui::NewFrame();
        std::vector<KeyPress> presses = mWindow->takeKeyPresses();
        if (input.key != 0) presses.push_back({input.key});
        bool isQuit = false;
        for (const KeyPress& press : presses) isQuit |= takeKey(mStage, mUiState, press);
        const ivec2 pixels = layOut(seconds);
        ImGui::Render();
        mStage.update(pixels, seconds);
        mWindow->setTitle(fmt::format("{} - {} - brume", mStage.document.file().filename().string(),
                                      describe(mStage.choices[0])));
        draw();
        if (!input.capture.empty()) capture(input.capture);
        if (mScript && input.isEnd) {
            mScript.reset();
            return true;
        }
        return isQuit;
    }

    // On top of what the window has taken from the user.
    void applyInput(const ScriptInput& input) {
        ImGuiIO& io = ImGui::GetIO();
        if (!input.mouse) return;
        io.MousePos = {static_cast<float>(input.mouse->x), static_cast<float>(input.mouse->y)};
        io.MouseDown[0] = input.isPressed;
    }

    ivec2 layOut(double seconds) {
        const ImVec2 size = ImGui::GetIO().DisplaySize;
        const ImGuiStyle& style = ImGui::GetStyle();
        const float bar = ImGui::GetFrameHeight() + 2 * style.WindowPadding.y;
        const float side =
            mUiState.isSideShown ? std::min(25 * ImGui::GetFontSize(), 0.5f * size.x) : 0;
        beginPart("picture", {0, 0}, {size.x - side, size.y - bar}, false);
        const ivec2 pixels = showPictures(mStage, mUiState, seconds);
        ImGui::End();
        beginPart("timeline", {0, size.y - bar}, {size.x, bar}, true);
        showTimeline(mStage);
        ImGui::End();
        if (side > 0) {
            beginPart("side", {size.x - side, 0}, {side, size.y - bar}, true);
            showSide(mStage, mUiState);
            ImGui::End();
        }
        showHelp(mUiState);
        return pixels;
    }

    void draw() {
        dropMissingPictures();
        const gpu::Image* image = mWindow->acquire();
        if (!image) return;
        mSubmitter.submitAndWait("window", [&](gpu::Commands& commands) {
            mUi->record(commands, *ImGui::GetDrawData(), *image);
            commands.transition(*image, mWindow->presentLayout());
        });
        mWindow->present();
    }

    // Laid out before, pictures may have lost their image since, to an error.
    void dropMissingPictures() {
        for (UiPicture& picture : mUiState.pictures)
            if (picture.image && !*picture.image) picture.image = nullptr;
    }

    void capture(const std::filesystem::path& file) {
        const ImGuiIO& io = ImGui::GetIO();
        const gpu::Image image(
            *mDevice,
            {.name = "view.capture",
             .format = mWindow->format(),
             .width = static_cast<std::uint32_t>(io.DisplaySize.x * io.DisplayFramebufferScale.x),
             .height = static_cast<std::uint32_t>(io.DisplaySize.y * io.DisplayFramebufferScale.y),
             .usage = gpu::kUsageColor | gpu::kUsageTransferRead});
        mSubmitter.submitAndWait("capture", [&](gpu::Commands& commands) {
            mUi->record(commands, *ImGui::GetDrawData(), image);
        });
        const std::vector<std::byte> texels = mSubmitter.read(image);
        const bool isBgra = image.format() == VK_FORMAT_B8G8R8A8_UNORM;
        std::vector<unsigned char> pixels;
        for (std::size_t i = 0; i < texels.size(); i += 4)
            for (const std::size_t channel : {0, 1, 2})
                pixels.push_back(
                    static_cast<unsigned char>(texels[i + (isBgra ? 2 - channel : channel)]));
        writeSrgb8(file, static_cast<int>(image.extent().width),
                   static_cast<int>(image.extent().height), pixels);
    }

    // In the order in which they need each other.
    ImGuiContextScope mContext;
    std::unique_ptr<Window> mWindow;  // its swapchain goes before the device: see the destructor
    std::unique_ptr<gpu::Device> mDevice;
    gpu::Submitter mSubmitter;
    Stage mStage;
    std::optional<UiPass> mUi;
    UiState mUiState;
    std::optional<Script> mScript;

  public:
    ~Viewer() { mWindow.reset(); }
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;
};

}  // namespace

std::vector<std::string> runViewer(const ViewerOptions& options, const Log& log) {
    Viewer viewer(options, log);
    viewer.run();
    return viewer.device().validationMessages();
}

}  // namespace brume::view
