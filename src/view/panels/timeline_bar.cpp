// SPDX-License-Identifier: Apache-2.0
#include <view/panels/panels.hpp>

#include <fmt/format.h>
#include <imgui.h>

namespace brume::view {

void showTimeline(Stage& stage) {
    Timeline& timeline = stage.timeline;
    const float em = ImGui::GetFontSize();
    if (ImGui::Button(timeline.isPlaying ? "Pause" : "Play", {4.2f * em, 0})) timeline.toggle();
    explain("Space");
    ImGui::SameLine();
    if (ImGui::Button("|<")) timeline.seek(0);
    explain("To the beginning (Home)");
    ImGui::SameLine();
    if (ImGui::Button("<")) timeline.step(-1);
    explain("One frame back (left arrow)");
    ImGui::SameLine();
    if (ImGui::Button(">")) timeline.step(1);
    explain("One frame on (right arrow)");
    ImGui::SameLine();
    auto now = static_cast<float>(timeline.now());
    ImGui::SetNextItemWidth(std::max(ImGui::GetContentRegionAvail().x - 27 * em, 5 * em));
    const std::string format = fmt::format("%.2f s   frame {}", timeline.frame());
    if (ImGui::SliderFloat("##time", &now, 0, static_cast<float>(timeline.end()), format.c_str()))
        timeline.seek(now);
    explain("Time of the effects; the picture is that of brume render --frame where all of them "
            "begin together");
    ImGui::SameLine();
    auto end = static_cast<float>(timeline.end());
    ImGui::SetNextItemWidth(5 * em);
    if (ImGui::DragFloat("##end", &end, 0.05f, 0.1f, 1e5f, "to %.1f s")) timeline.setEnd(end);
    explain("End of the timeline");
    ImGui::SameLine();
    ImGui::Checkbox("loop", &timeline.isLooping);
    ImGui::SameLine();
    ImGui::Checkbox("every frame", &timeline.showsEveryFrame);
    explain("Show every frame, however long it takes; else time runs as on a clock, but never by "
            "more than 0.1 s from one picture to the next");
    ImGui::SameLine();
    auto speed = static_cast<float>(timeline.speed);
    ImGui::SetNextItemWidth(4 * em);
    if (ImGui::DragFloat("##speed", &speed, 0.01f, 0.01f, 10, "%.2f x")) timeline.speed = speed;
    explain("Speed of the clock");
}

}  // namespace brume::view
