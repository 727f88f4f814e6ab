// SPDX-License-Identifier: Apache-2.0
#include <view/panels/panels.hpp>

#include <imgui.h>

namespace brume::view {
namespace {

bool beginSection(const char* title, bool isOpen) {
    return ImGui::CollapsingHeader(title, isOpen ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

}  // namespace

void showSide(Stage& stage, UiState& ui) {
    if (beginSection("Method", true)) showChoice(stage, 0);
    if (beginSection("Comparison", true)) showComparison(stage);
    if (beginSection("Time of the passes", true)) {
        showTimes(stage, 0);
        if (stage.isSplit) {
            ImGui::Separator();
            ImGui::TextDisabled("right");
            showTimes(stage, 1);
        }
    }
    if (beginSection("Effects", false)) showEffects(stage);
    if (beginSection("View", false)) showView(stage);
    if (beginSection("Output", false)) showOutput(stage, ui);
}

void showComparison(Stage& stage) {
    struct Offer {
        const char* name;
        Show show;
        const char* meaning;
    };
    constexpr Offer kOffers[] = {
        {"picture", Show::Picture, "What the method makes (1)"},
        {"reference", Show::Reference,
         "The exact image, computed on the processor in double precision (2)"},
        {"errors", Show::Errors,
         "Absolute difference to the exact image, on a logarithmic scale (3)"},
        {"layers", Show::Layers,
         "How many media and surfaces lie in each pixel: the length of exact lists (4)"},
        {"fragments", Show::Fragments,
         "How often rastered methods shade each pixel, misses included: overdraw (5)"}};
    for (const Offer& offer : kOffers) {
        if (offer.show != Show::Picture && offer.show != Show::Layers) ImGui::SameLine();
        if (ImGui::RadioButton(offer.name, stage.show == offer.show)) stage.show = offer.show;
        explain(offer.meaning);
    }
    ImGui::Checkbox("split the picture", &stage.isSplit);
    explain("A second method on the right (C); drag the line between them");
    if (!stage.isSplit) return;
    ImGui::TextDisabled("right");
    ImGui::SameLine();
    if (ImGui::SmallButton("swap")) std::swap(stage.choices[0], stage.choices[1]);
    showChoice(stage, 1);
}

void showView(Stage& stage) {
    CameraControl& camera = stage.camera;
    const float width = 9 * ImGui::GetFontSize();
    bool isFlying = camera.mode == CameraMode::Fly;
    if (ImGui::Checkbox("fly", &isFlying))
        camera.mode = isFlying ? CameraMode::Fly : CameraMode::Orbit;
    explain("Drag to look around, W A S D to move, E and Q up and down (F)");
    ImGui::SameLine();
    if (ImGui::Button("Back to the scene's camera")) camera.reset();
    explain("R");
    if (isFlying) {
        auto speed = static_cast<float>(camera.speed);
        ImGui::SetNextItemWidth(width);
        if (ImGui::DragFloat("speed", &speed, 0.01f * speed, 1e-6f, 1e6f, "%.3g m/s"))
            camera.speed = speed;
        explain("Also the wheel");
    }
    auto exposure = static_cast<float>(stage.exposure);
    ImGui::SetNextItemWidth(width);
    if (ImGui::SliderFloat("exposure", &exposure, -8, 8, "%+.1f stops")) stage.exposure = exposure;
    ImGui::SetNextItemWidth(width);
    const int divisors[] = {1, 2, 4};
    const char* const names[] = {"full", "half", "quarter"};
    int index = stage.resolutionDivisor == 4 ? 2 : stage.resolutionDivisor - 1;
    if (ImGui::Combo("resolution", &index, names, 3)) stage.resolutionDivisor = divisors[index];
    explain("Of pictures that stand still, in each direction");
    ImGui::Checkbox("coarser while it moves", &stage.preview.isEnabled);
    auto budget = static_cast<float>(stage.preview.budgetMs);
    ImGui::SetNextItemWidth(width);
    if (ImGui::DragFloat("for a moving picture", &budget, 1, 5, 2000, "%.0f ms"))
        stage.preview.budgetMs = budget;
    explain("While the camera or the time moves, the resolution goes down to 1/8 to keep to it");
}

void showOutput(Stage& stage, UiState& ui) {
    if (ImGui::Button("Save picture (.png)")) stage.saveScreenshot("brume.png");
    explain("brume.png in the folder that the viewer was started in (P)");
    ImGui::SameLine();
    if (ImGui::Button(".exr")) stage.saveScreenshot("brume.exr");
    ImGui::SetNextItemWidth(-1);
    ImGui::InputText("##record", ui.recordFile, sizeof(ui.recordFile));
    explain(hasFfmpeg() ? "A sequence (frames/####.png or .exr) or a film (.mp4, .mkv, .webm)"
                        : "A sequence: frames/####.png or .exr. Films need ffmpeg, which is not "
                          "installed");
    if (stage.isRecording()) {
        if (ImGui::Button("Stop")) stage.stopRecording();
    } else if (ImGui::Button("Record the timeline")) {
        stage.startRecording(ui.recordFile);
    }
    explain("From the beginning to the end of the timeline, in the size that the scene says");
}

}  // namespace brume::view
