// SPDX-License-Identifier: Apache-2.0
#include <view/panels/panels.hpp>
#include <view/window.hpp>

#include <oit/method_info.hpp>

#include <imgui.h>

#include <iterator>

namespace brume::view {
namespace {

bool isPressed(int key) { return ImGui::IsKeyPressed(key, false); }

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
    {"1, 2, 3", "picture, reference, errors"},
    {"P", "save the picture"},
    {"H", "hide the column at the side"},
    {"F1", "this list"},
    {"Ctrl Q", "quit"}};

}  // namespace

bool takeKeys(Stage& stage, UiState& ui) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantTextInput) return false;
    if (io.KeyCtrl) return isPressed('Q');
    if (isPressed(kKeySpace)) stage.timeline.toggle();
    if (isPressed(kKeyLeft)) stage.timeline.step(-1);
    if (isPressed(kKeyRight)) stage.timeline.step(1);
    if (isPressed(kKeyHome)) stage.timeline.seek(0);
    if (isPressed(kKeyEnd)) stage.timeline.seek(stage.timeline.end());
    if (isPressed('F'))
        stage.camera.mode =
            stage.camera.mode == CameraMode::Fly ? CameraMode::Orbit : CameraMode::Fly;
    if (isPressed('R')) stage.camera.reset();
    if (isPressed('M')) chooseNextMethod(stage);
    if (isPressed('C')) stage.isSplit = !stage.isSplit;
    if (isPressed('1')) stage.show = Show::Picture;
    if (isPressed('2')) stage.show = Show::Reference;
    if (isPressed('3')) stage.show = Show::Errors;
    if (isPressed('P')) stage.saveScreenshot("brume.png");
    if (isPressed('H')) ui.isSideShown = !ui.isSideShown;
    if (isPressed(kKeyF1)) ui.isHelpShown = !ui.isHelpShown;
    if (isPressed(kKeyEscape)) ui.isHelpShown = false;
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
