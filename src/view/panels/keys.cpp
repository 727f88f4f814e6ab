// SPDX-License-Identifier: Apache-2.0
#include <view/panels/panels.hpp>

#include <oit/method_info.hpp>

#include <imgui.h>

#include <iterator>

namespace brume::view {
namespace {

/// The method after it in the registry.
void chooseNextMethod(Stage& stage) {
    const auto methods = oit::listMethods();
    for (std::size_t i = 0; i < methods.size(); ++i)
        if (methods[i].name == stage.choices[0].method) {
            const std::size_t next = (i + 1) % methods.size();
            stage.choices[0] = {std::string(methods[next].name), {}, stage.choices[0].shadow};
            return;
        }
}

struct KeyHelp {
    const char* key;
    const char* meaning;
};

constexpr KeyHelp kHelp[] = {
    {"drag", "around the target (orbit), look around (fly)"},
    {"right or middle drag, Shift drag", "shift"},
    {"wheel", "nearer and farther (orbit), speed (fly)"},
    {"F", "fly or orbit; W A S D E Q to fly"},
    {"R", "back to the scene's camera"},
    {"Space", "play, pause"},
    {"left, right", "one frame back, on"},
    {"Home, End", "beginning, end"},
    {"M", "next method"},
    {"C", "compare with a second method"},
    {"1, 2, 3, 4, 5", "picture, reference, errors, layers, fragments"},
    {"P", "save the picture"},
    {"H", "hide the column at the side"},
    {"F1", "this list"},
    {"Ctrl Q", "quit"}};

void takeTimelineKey(Timeline& timeline, int key) {
    if (key == kKeySpace) timeline.toggle();
    if (key == kKeyLeft) timeline.step(-1);
    if (key == kKeyRight) timeline.step(1);
    if (key == kKeyHome) timeline.seek(0);
    if (key == kKeyEnd) timeline.seek(timeline.end());
}

}  // namespace

bool takeKey(Stage& stage, UiState& ui, const KeyPress& press) {
    if (ImGui::GetIO().WantTextInput) return false;
    const int key = press.key;
    if (press.isControl) return key == 'Q';
    takeTimelineKey(stage.timeline, key);
    CameraControl& camera = stage.camera;
    if (key == 'F')
        camera.mode = camera.mode == CameraMode::Fly ? CameraMode::Orbit : CameraMode::Fly;
    if (key == 'R') camera.reset();
    if (key == 'M') chooseNextMethod(stage);
    if (key == 'C') stage.isSplit = !stage.isSplit;
    if (key == '1') stage.show = Show::Picture;
    if (key == '2') stage.show = Show::Reference;
    if (key == '3') stage.show = Show::Errors;
    if (key == '4') stage.show = Show::Layers;
    if (key == '5') stage.show = Show::Fragments;
    if (key == 'P') stage.saveScreenshot("brume.png");
    if (key == 'H') ui.isSideShown = !ui.isSideShown;
    if (key == kKeyF1) ui.isHelpShown = !ui.isHelpShown;
    if (key == kKeyEscape) ui.isHelpShown = false;
    return false;
}

void showHelp(UiState& ui) {
    if (!ui.isHelpShown) return;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::Begin("Keys", &ui.isHelpShown,
                 ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings);
    for (const KeyHelp& help : kHelp) {
        ImGui::TextUnformatted(help.key);
        ImGui::SameLine(17 * ImGui::GetFontSize());
        ImGui::TextDisabled("%s", help.meaning);
    }
    ImGui::End();
}

}  // namespace brume::view
