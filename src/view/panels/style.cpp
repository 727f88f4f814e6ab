// SPDX-License-Identifier: Apache-2.0
#include <view/panels/panels.hpp>

#include <imgui.h>

#include <filesystem>

namespace brume::view {
namespace {

// Debian's fonts-dejavu-core; without it ImGui's own bitmap font serves.
constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr float kFontSize = 14;

ImVec4 grey(float level, float alpha = 1) { return {level, level, level * 1.06f, alpha}; }

void setColors(ImGuiStyle& style) {
    const ImVec4 accent(0.93f, 0.56f, 0.25f, 1), dimmed(0.93f, 0.56f, 0.25f, 0.55f);
    ImVec4* colors = style.Colors;
    colors[ImGuiCol_Text] = grey(0.9f);
    colors[ImGuiCol_TextDisabled] = grey(0.55f);
    colors[ImGuiCol_WindowBg] = grey(0.1f);
    colors[ImGuiCol_PopupBg] = grey(0.14f, 0.98f);
    colors[ImGuiCol_TitleBgActive] = colors[ImGuiCol_TitleBg] = grey(0.2f);
    colors[ImGuiCol_Border] = grey(0.22f);
    colors[ImGuiCol_FrameBg] = grey(0.18f);
    colors[ImGuiCol_FrameBgHovered] = grey(0.24f);
    colors[ImGuiCol_FrameBgActive] = grey(0.28f);
    colors[ImGuiCol_Header] = grey(0.2f);
    colors[ImGuiCol_HeaderHovered] = grey(0.27f);
    colors[ImGuiCol_HeaderActive] = grey(0.3f);
    colors[ImGuiCol_Button] = grey(0.22f);
    colors[ImGuiCol_ButtonHovered] = grey(0.3f);
    colors[ImGuiCol_ButtonActive] = dimmed;
    colors[ImGuiCol_CheckMark] = accent;
    colors[ImGuiCol_SliderGrab] = dimmed;
    colors[ImGuiCol_SliderGrabActive] = accent;
    colors[ImGuiCol_PlotHistogram] = accent;
    colors[ImGuiCol_ScrollbarBg] = grey(0.1f);
    colors[ImGuiCol_ScrollbarGrab] = grey(0.3f);
}

}  // namespace

void setStyle(double scale) {
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    setColors(style);
    style.WindowRounding = 0;
    style.WindowBorderSize = 0;
    style.FrameRounding = 3;
    style.GrabRounding = 3;
    style.FramePadding = {7, 4};
    style.ItemSpacing = {7, 5};
    style.ScrollbarSize = 11;
    const auto factor = static_cast<float>(scale);
    style.ScaleAllSizes(factor);
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    std::error_code ignored;
    if (std::filesystem::exists(kFont, ignored)) {
        static const ImWchar kRanges[] = {0x20, 0xff, 0};
        fonts.AddFontFromFileTTF(kFont, kFontSize * factor, nullptr, kRanges);
    } else {
        ImFontConfig config;
        config.SizePixels = 13 * factor;
        fonts.AddFontDefault(&config);
    }
}

void explain(const std::string& text) {
    if (text.empty() || !ImGui::IsItemHovered()) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

}  // namespace brume::view
