// SPDX-License-Identifier: Apache-2.0
#include <view/panels/panels.hpp>

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace brume::view {
namespace {

constexpr ImU32 kLight = IM_COL32(235, 235, 240, 255), kDim = IM_COL32(190, 190, 200, 255),
                kShade = IM_COL32(0, 0, 0, 165), kRed = IM_COL32(255, 120, 105, 255),
                kAccent = IM_COL32(237, 143, 64, 255);

/// Text on a shade of its own; returns the height taken.
float drawLabel(ImDrawList& list, ImVec2 at, const std::string& text, ImU32 color) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const float pad = 0.35f * ImGui::GetFontSize();
    list.AddRectFilled(at, {at.x + size.x + 2 * pad, at.y + size.y + pad}, kShade, 3);
    list.AddText({at.x + pad, at.y + 0.5f * pad}, color, text.c_str());
    return size.y + 1.5f * pad;
}

bool isKeyDown(int key) { return ImGui::GetIO().KeysDown[key]; }

void takeInput(Stage& stage, UiState& ui, double seconds, double viewHeight) {
    const ImGuiIO& io = ImGui::GetIO();
    CameraInput input{.seconds = seconds, .viewHeight = viewHeight};
    const bool isHeld = ImGui::IsItemActive();
    ui.isPictureHovered = ImGui::IsItemHovered();
    if (isHeld && !ui.isDividerHeld) {
        const dvec2 drag(io.MouseDelta.x, io.MouseDelta.y);
        const bool isShift = io.MouseDown[1] || io.MouseDown[2] || io.KeyShift;
        (isShift ? input.shift : input.turn) = drag;
    }
    if (ui.isPictureHovered) input.zoom = io.MouseWheel;
    if (stage.camera.mode == CameraMode::Fly && !io.WantTextInput && !io.KeyCtrl) {
        const auto axis = [](int plus, int minus) {
            return static_cast<double>(isKeyDown(plus)) - static_cast<double>(isKeyDown(minus));
        };
        input.move = {axis('D', 'A'), axis('E', 'Q'), axis('W', 'S')};
    }
    stage.camera.apply(input);
}

const gpu::Image* imageOf(const Stage& stage, std::size_t index) {
    const ComparisonState& comparison = stage.comparison();
    if (stage.show == Show::Picture || comparison.divisor == 0) return stage.pane(index).image();
    if (stage.show == Show::Reference) return &comparison.exact;
    return comparison.errors[index] ? &comparison.errors[index] : nullptr;
}

/// Black 1e-6 to white 1, as bench::paintErrors() has it.
void drawScale(ImDrawList& list, ImVec2 from, ImVec2 to) {
    struct Stop {
        float at;
        ImU32 color;
        const char* text;
    };
    const Stop stops[] = {{0, IM_COL32(0, 0, 0, 255), "1e-6"},
                          {1 / 6.0f, IM_COL32(0, 0, 255, 255), "1e-5"},
                          {0.5f, IM_COL32(0, 255, 0, 255), "1e-3"},
                          {4 / 6.0f, IM_COL32(255, 255, 0, 255), "0.01"},
                          {5 / 6.0f, IM_COL32(255, 0, 0, 255), "0.1"},
                          {1, IM_COL32(255, 255, 255, 255), "1"}};
    const float line = ImGui::GetFontSize(), width = to.x - from.x;
    list.AddRectFilled({from.x - line, from.y - 0.4f * line}, {to.x + line, to.y + 1.5f * line},
                       kShade, 3);
    for (std::size_t i = 0; i + 1 < std::size(stops); ++i)
        list.AddRectFilledMultiColor({from.x + stops[i].at * width, from.y},
                                     {from.x + stops[i + 1].at * width, to.y}, stops[i].color,
                                     stops[i + 1].color, stops[i + 1].color, stops[i].color);
    for (const Stop& stop : stops) {
        const float half = 0.5f * ImGui::CalcTextSize(stop.text).x;
        list.AddText({from.x + stop.at * width - half, to.y + 0.2f * line}, kLight, stop.text);
    }
}

std::string describeState(const Stage& stage, std::size_t index) {
    const Pane& pane = stage.pane(index);
    if (!pane.image()) return describe(stage.choices[index]);
    std::string text = fmt::format("{}   {:.1f} ms", describe(pane.choice()),
                                   pane.result().timeMs);
    if (pane.result().errorBound && *pane.result().errorBound > 0)
        text += fmt::format("   off by at most {:.1e}", *pane.result().errorBound);
    return text;
}

std::string describeErrors(const Stage& stage, std::size_t index) {
    const bench::ErrorMetrics& m = stage.comparison().metrics[index];
    return fmt::format("rmse {:.2e}   max {:.2e}   bias {:+.2e}   flip {:.3f}", m.rmse, m.max,
                       m.bias, m.flip);
}

/// What there is to know about one picture, from the corner down.
void drawCaption(const Stage& stage, ImDrawList& list, std::size_t index, ImVec2 at) {
    const bool isCompared = stage.show != Show::Picture;
    at.y += drawLabel(list, at, describeState(stage, index), kLight);
    if (!stage.pane(index).problem().empty()) drawLabel(list, at, "not up to date: see below", kRed);
    if (!isCompared) return;
    if (stage.comparison().divisor > 0)
        at.y += drawLabel(list, at, describeErrors(stage, index), kDim);
    if (index > 0) return;
    if (const auto progress = stage.comparisonProgress())
        drawLabel(list, at, fmt::format("computing the reference {:.0f} %", 100 * *progress), kAccent);
    else if (stage.comparison().divisor == 0)
        drawLabel(list, at, "the reference begins when the picture stands still", kAccent);
}

/// The line between two pictures, which can be dragged.
void showDivider(Stage& stage, UiState& ui, ImVec2 from, ImVec2 size) {
    const float x = from.x + static_cast<float>(stage.splitAt) * size.x;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float reach = 0.5f * ImGui::GetFontSize();
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const bool isNear = std::abs(mouse.x - x) < reach && mouse.y > from.y &&
                        mouse.y < from.y + size.y && ui.isPictureHovered;
    if (isNear && ImGui::IsMouseClicked(0)) ui.isDividerHeld = true;
    if (!ImGui::IsMouseDown(0)) ui.isDividerHeld = false;
    if (ui.isDividerHeld)
        stage.splitAt =
            std::clamp(static_cast<double>((mouse.x - from.x) / size.x), 0.02, 0.98);
    if (isNear || ui.isDividerHeld) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    list.AddLine({x, from.y}, {x, from.y + size.y}, isNear ? kAccent : kLight, 2);
}

void drawMessages(const Stage& stage, ImDrawList& list, ImVec2 from, ImVec2 size) {
    const float line = ImGui::GetFontSize();
    ImVec2 at(from.x + 0.7f * line, from.y + size.y - 2.2f * line);
    if (stage.message().secondsLeft > 0) {
        const std::string& text = stage.message().text;
        const float wrap = size.x - 2.5f * line;
        const ImVec2 extent = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
        at.y = from.y + size.y - extent.y - 1.2f * line;
        list.AddRectFilled({at.x - 0.3f * line, at.y - 0.3f * line},
                           {at.x + extent.x + 0.3f * line, at.y + extent.y + 0.3f * line}, kShade,
                           3);
        list.AddText(ImGui::GetFont(), line, at, stage.message().isError ? kRed : kLight,
                     text.c_str(), nullptr, wrap);
        at.y -= 2 * line;
    }
    if (stage.isRecording())
        drawLabel(list, at,
                  fmt::format("recording {:.0f} %", 100 * stage.recordingProgress()), kAccent);
    else if (stage.shownDivisor() > stage.resolutionDivisor)
        drawLabel(list, at,
                  fmt::format("preview at 1/{} of the resolution while it moves", stage.shownDivisor()),
                  kAccent);
}

}  // namespace

std::string describe(const PaneChoice& choice) {
    return choice.shadow.empty() ? choice.method
                                 : fmt::format("{}, shadows {}", choice.method, choice.shadow);
}

ivec2 showPictures(Stage& stage, UiState& ui, double seconds) {
    const ImVec2 from = ImGui::GetCursorScreenPos(), size = ImGui::GetContentRegionAvail();
    const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
    const ivec2 pixels(static_cast<int>(size.x * scale.x), static_cast<int>(size.y * scale.y));
    if (pixels.x < 1 || pixels.y < 1) return {0, 0};
    ImGui::InvisibleButton("picture", size,
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    takeInput(stage, ui, seconds, size.y);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float split = stage.isSplit ? static_cast<float>(stage.splitAt) : 1;
    const float line = ImGui::GetFontSize();
    for (std::size_t i = 0; i < (stage.isSplit ? 2u : 1u); ++i) {
        const gpu::Image* image = imageOf(stage, i);
        const float lo = i == 0 ? 0 : split, hi = i == 0 ? split : 1;
        // Painted errors are not radiance: exposure is not for them.
        const bool isRadiance = stage.show != Show::Errors || stage.comparison().divisor == 0;
        ui.pictures[i] = {image, isRadiance ? static_cast<float>(std::exp2(stage.exposure)) : 1.0f,
                          isRadiance};
        if (image)
            list.AddImage(&ui.pictures[i], {from.x + lo * size.x, from.y},
                          {from.x + hi * size.x, from.y + size.y}, {lo, 0}, {hi, 1});
        list.PushClipRect({from.x + lo * size.x, from.y}, {from.x + hi * size.x, from.y + size.y},
                          true);
        drawCaption(stage, list, i, {from.x + lo * size.x + 0.6f * line, from.y + 0.6f * line});
        list.PopClipRect();
    }
    if (stage.isSplit) showDivider(stage, ui, from, size);
    if (stage.show == Show::Errors && stage.comparison().divisor > 0 && size.x > 30 * line)
        drawScale(list, {from.x + size.x - 20 * line, from.y + size.y - 3 * line},
                  {from.x + size.x - 2 * line, from.y + size.y - 2.3f * line});
    drawMessages(stage, list, from, size);
    return pixels;
}

}  // namespace brume::view
