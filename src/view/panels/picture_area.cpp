// SPDX-License-Identifier: Apache-2.0
#include <view/panels/panels.hpp>

#include <core/image_io.hpp>
#include <oit/layer_count.hpp>

#include <shaders/common/heat.h>

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <span>

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
    if (!isComparing(stage.show) || comparison.divisor == 0) return stage.pane(index).image();
    if (stage.show == Show::Reference) return &comparison.exact;
    return comparison.errors[index] ? &comparison.errors[index] : nullptr;
}

/// One colour of heatColor() and what it stands for.
struct Mark {
    float at;
    const char* text;
};

ImU32 heatOf(float at) {
    const vec3 linear = shader::heatColor(at);
    const auto encode = [](float x) {
        return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
    };
    return ImGui::ColorConvertFloat4ToU32(
        {encode(toneMap(linear.x)), encode(toneMap(linear.y)), encode(toneMap(linear.z)), 1});
}

void drawScale(ImDrawList& list, ImVec2 from, ImVec2 to, std::span<const Mark> marks) {
    constexpr int kSteps = 60;
    const float line = ImGui::GetFontSize(), width = to.x - from.x;
    list.AddRectFilled({from.x - 1.5f * line, from.y - 0.4f * line},
                       {to.x + 1.5f * line, to.y + 1.5f * line}, kShade, 3);
    for (int i = 0; i < kSteps; ++i) {
        const float lo = static_cast<float>(i) / kSteps, hi = static_cast<float>(i + 1) / kSteps;
        const ImU32 left = heatOf(lo * shader::kHeatSteps), right = heatOf(hi * shader::kHeatSteps);
        list.AddRectFilledMultiColor({from.x + lo * width, from.y}, {from.x + hi * width, to.y},
                                     left, right, right, left);
    }
    for (const Mark& mark : marks) {
        const float half = 0.5f * ImGui::CalcTextSize(mark.text).x;
        list.AddText({from.x + mark.at / shader::kHeatSteps * width - half, to.y + 0.2f * line},
                     kLight, mark.text);
    }
}

void drawScale(const Stage& stage, ImDrawList& list, ImVec2 corner) {
    const float line = ImGui::GetFontSize();
    const ImVec2 from(corner.x - 21 * line, corner.y - 3 * line),
        to(corner.x - 2.5f * line, corner.y - 2.3f * line);
    if (stage.show == Show::Errors && stage.comparison().divisor > 0) {
        constexpr Mark kErrors[] = {{0, "1e-6"}, {1, "1e-5"}, {2, "1e-4"}, {3, "0.001"},
                                    {4, "0.01"}, {5, "0.1"},  {6, "1"}};
        drawScale(list, from, to, kErrors);
    } else if (stage.show == Show::Layers || stage.show == Show::Fragments) {
        const auto at = [](double layers) { return oit::layer_count::heatOf(layers); };
        const Mark marks[] = {{0, "0"},       {at(1), "1"},     {at(4), "4"},      {at(16), "16"},
                              {at(64), "64"}, {at(256), "256"}, {at(1024), "1024"}};
        drawScale(list, from, to, marks);
    }
}

std::string describeState(const Stage& stage, std::size_t index) {
    const Pane& pane = stage.pane(index);
    if (!pane.image()) return describe(stage.choices[index]);
    const bool isCounting = pane.choice().method == oit::layer_count::kName;
    std::string text = isCounting ? "layers per pixel" : describe(pane.choice());
    if (isCounting && stage.show == Show::Fragments) text = "fragments per pixel";
    text += fmt::format("   {:.1f} ms", pane.result().timeMs);
    if (pane.result().errorBound && *pane.result().errorBound > 0)
        text += fmt::format("   off by at most {:.1e}", *pane.result().errorBound);
    return text;
}

/// In one line, or in two where `width` asks for it; returns the height taken.
float drawErrors(const Stage& stage, ImDrawList& list, std::size_t index, ImVec2 at, float width) {
    const bench::ErrorMetrics& m = stage.comparison().metrics[index];
    const std::string first = fmt::format("rmse {:.2e}   max {:.2e}", m.rmse, m.max),
                      second = fmt::format("bias {:+.2e}   flip {:.3f}", m.bias, m.flip),
                      both = first + "   " + second;
    if (ImGui::CalcTextSize(both.c_str()).x + 2 * ImGui::GetFontSize() < width)
        return drawLabel(list, at, both, kDim);
    const float height = drawLabel(list, at, first, kDim);
    return height + drawLabel(list, {at.x, at.y + height}, second, kDim);
}

/// What there is to know about one picture, from the corner down.
void drawCaption(const Stage& stage, ImDrawList& list, std::size_t index, ImVec2 at, float width) {
    const bool isCompared = isComparing(stage.show);
    at.y += drawLabel(list, at, describeState(stage, index), kLight);
    if (!stage.pane(index).problem().empty())
        drawLabel(list, at, "not up to date: see below", kRed);
    if (!isCompared) return;
    if (stage.comparison().divisor > 0) at.y += drawErrors(stage, list, index, at, width);
    if (index > 0) return;
    if (const auto progress = stage.comparisonProgress())
        drawLabel(list, at, fmt::format("computing the reference {:.0f} %", 100 * *progress),
                  kAccent);
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
        stage.splitAt = std::clamp(static_cast<double>((mouse.x - from.x) / size.x), 0.02, 0.98);
    if (isNear || ui.isDividerHeld) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    list.AddLine({x, from.y}, {x, from.y + size.y}, isNear ? kAccent : kLight, 2);
}

/// Returns the height that a message takes.
float drawMessages(const Stage& stage, ImDrawList& list, ImVec2 from, ImVec2 size) {
    const float line = ImGui::GetFontSize();
    float taken = 0;
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
        taken = extent.y + 1.2f * line;
    }
    if (stage.isRecording())
        drawLabel(list, at, fmt::format("recording {:.0f} %", 100 * stage.recordingProgress()),
                  kAccent);
    else if (stage.shownDivisor() > stage.resolutionDivisor)
        drawLabel(
            list, at,
            fmt::format("preview at 1/{} of the resolution while it moves", stage.shownDivisor()),
            kAccent);
    return taken;
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
        // Painted figures are not radiance: exposure is not for them.
        const bool isRadiance = stage.show == Show::Picture || stage.show == Show::Reference;
        ui.pictures[i] = {image, isRadiance ? static_cast<float>(std::exp2(stage.exposure)) : 1.0f,
                          isRadiance};
        if (image)
            list.AddImage(&ui.pictures[i], {from.x + lo * size.x, from.y},
                          {from.x + hi * size.x, from.y + size.y}, {lo, 0}, {hi, 1});
        list.PushClipRect({from.x + lo * size.x, from.y}, {from.x + hi * size.x, from.y + size.y},
                          true);
        drawCaption(stage, list, i, {from.x + lo * size.x + 0.6f * line, from.y + 0.6f * line},
                    (hi - lo) * size.x);
        list.PopClipRect();
    }
    if (stage.isSplit) showDivider(stage, ui, from, size);
    const float messages = drawMessages(stage, list, from, size);
    if (size.x > 30 * line) drawScale(stage, list, {from.x + size.x, from.y + size.y - messages});
    return pixels;
}

}  // namespace brume::view
