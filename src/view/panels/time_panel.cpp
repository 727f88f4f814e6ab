// SPDX-License-Identifier: Apache-2.0
// Times of passes as a graph, counters and memory.
#include <view/panels/panels.hpp>

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace brume::view {
namespace {

ImU32 colorOf(std::size_t name) {
    // Steps of the golden ratio around the hue circle: neighbours differ.
    const float hue = static_cast<float>(name) * 0.618034f;
    float r = 0, g = 0, b = 0;
    ImGui::ColorConvertHSVtoRGB(hue - static_cast<float>(static_cast<int>(hue)), 0.55f, 0.85f, r, g,
                                b);
    return ImGui::ColorConvertFloat4ToU32({r, g, b, 1});
}

/// The lightest round number not below.
double roundUp(double value) {
    double step = 1e-3;
    for (int i = 0;; ++i) {
        for (const double factor : {1.0, 2.0, 5.0})
            if (factor * step >= value) return factor * step;
        step *= 10;
        if (i > 12) return value;
    }
}

/// Pictures from left to right, each a column of its passes.
void drawGraph(const PassHistory& history) {
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const ImVec2 size(ImGui::GetContentRegionAvail().x, 6 * ImGui::GetFontSize());
    ImGui::InvisibleButton("graph", size);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(from, {from.x + size.x, from.y + size.y}, IM_COL32(12, 12, 14, 255), 3);
    const double top = roundUp(history.longestMs());
    const float width = size.x / PassHistory::kLength;
    for (std::size_t i = 0; i < history.pictureCount(); ++i) {
        const float x = from.x + width * static_cast<float>(PassHistory::kLength -
                                                            history.pictureCount() + i);
        float y = from.y + size.y;
        for (std::size_t name = 0; name < history.names().size(); ++name) {
            const auto height = static_cast<float>(history.timeMs(i, name) / top) * size.y;
            list.AddRectFilled({x, y - height}, {x + width, y}, colorOf(name));
            y -= height;
        }
    }
    list.AddText({from.x + 5, from.y + 2}, IM_COL32(190, 190, 200, 255),
                 fmt::format("{:g} ms", top).c_str());
}

void showRow(const std::string& name, const std::string& value) {
    ImGui::TextUnformatted(name.c_str());
    const float width = ImGui::CalcTextSize(value.c_str()).x;
    ImGui::SameLine(ImGui::GetContentRegionMax().x - width);
    ImGui::TextUnformatted(value.c_str());
}

std::string formatMebibytes(std::uint64_t bytes) {
    return fmt::format("{:.2f} MiB", static_cast<double>(bytes) / (1 << 20));
}

}  // namespace

void showTimes(const Stage& stage, std::size_t index) {
    const PassHistory& history = stage.history(index);
    if (history.pictureCount() == 0) return;
    ImGui::PushID(static_cast<int>(index));
    drawGraph(history);
    const std::size_t last = history.pictureCount() - 1;
    for (std::size_t name = 0; name < history.names().size(); ++name) {
        ImGui::PushStyleColor(ImGuiCol_Text, colorOf(name));
        showRow(history.names()[name], fmt::format("{:.2f} ms", history.timeMs(last, name)));
        ImGui::PopStyleColor();
    }
    showRow("all passes", fmt::format("{:.2f} ms", history.totalMs(last)));
    showRow("with preparation, on the clock", fmt::format("{:.0f} ms", stage.pane(index).wallMs()));
    const render::Result& result = stage.pane(index).result();
    if (ImGui::TreeNode("counters")) {
        for (const auto& [name, count] : result.counters) showRow(name, fmt::format("{}", count));
        ImGui::TreePop();
    }
    if (ImGui::TreeNode("device memory")) {
        for (const auto& [name, bytes] : result.bytes)
            showRow(name,
                    name == "perPixel" ? fmt::format("{} B", bytes) : formatMebibytes(bytes));
        ImGui::TreePop();
    }
    ImGui::PopID();
}

}  // namespace brume::view
