// SPDX-License-Identifier: Apache-2.0
// The effects of the scene, value by value.
#include <view/panels/panels.hpp>

#include <core/error.hpp>

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace brume::view {
namespace {

bool editWord(EffectKey& key) {
    bool isChanged = false;
    if (!ImGui::BeginCombo("##value", key.word.c_str())) return false;
    for (const std::string& choice : key.choices)
        if (ImGui::Selectable(choice.c_str(), choice == key.word)) {
            key.word = choice;
            isChanged = true;
        }
    ImGui::EndCombo();
    return isChanged;
}

bool editNumbers(EffectKey& key) {
    double largest = 0;
    for (const double value : key.values) largest = std::max(largest, std::abs(value));
    const auto step = static_cast<float>(key.isInteger ? std::max(0.1, 0.005 * largest)
                                                       : std::max(0.005 * largest, 0.002));
    const std::string unit = key.unit.empty() || key.values.size() > 1 ? "" : " " + key.unit;
    const std::string format = (key.isInteger ? "%.0f" : "%.4g") + unit;
    return ImGui::DragScalarN("##value", ImGuiDataType_Double, key.values.data(),
                              static_cast<int>(key.values.size()), step, &key.lo, &key.hi,
                              format.c_str(), ImGuiSliderFlags_AlwaysClamp);
}

/// Where the values of a group begin: right of its longest name.
float findColumn(const EffectGroup& group) {
    float widest = 4.5f * ImGui::GetFontSize();
    for (const EffectKey& key : group.keys)
        widest = std::max(widest, ImGui::CalcTextSize(key.name.c_str()).x);
    return ImGui::GetCursorPosX() + widest + ImGui::GetStyle().ItemSpacing.x;
}

/// Whether it was changed.
bool showKey(EffectKey& key, float column) {
    ImGui::PushID(key.pointer.c_str());
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(key.name.c_str());
    explain(fmt::format("{}{}{}", key.summary, key.unit.empty() ? "" : "\n\nUnit: ", key.unit));
    ImGui::SameLine(column);
    ImGui::SetNextItemWidth(-1);
    const bool isChanged = key.choices.empty() ? editNumbers(key) : editWord(key);
    ImGui::PopID();
    return isChanged;
}

void showEffect(Stage& stage, EffectEdit& edit) {
    for (EffectGroup& group : edit.groups()) {
        ImGui::PushID(group.keys.empty() ? group.title.c_str() : group.keys[0].pointer.c_str());
        const bool isOpen =
            ImGui::TreeNodeEx(group.title.c_str(), ImGuiTreeNodeFlags_SpanAvailWidth);
        explain(group.summary);
        if (isOpen) {
            const float column = findColumn(group);
            for (EffectKey& key : group.keys)
                if (showKey(key, column))
                    stage.attempt([&] {
                        edit.set(key);
                        stage.document.applyEffects();
                    });
            ImGui::TreePop();
        }
        ImGui::PopID();
    }
    if (ImGui::Button("Save"))
        stage.attempt([&] {
            edit.save();
            stage.say("saved " + edit.file().filename().string());
        });
    explain("Writes the file; comments, order and everything else in it stay");
    ImGui::SameLine();
    if (ImGui::Button("Revert"))
        stage.attempt([&] {
            edit.reload();
            stage.document.applyEffects();
        });
    explain("Back to what is in the file");
}

}  // namespace

void showEffects(Stage& stage) {
    if (stage.document.effects().empty()) {
        ImGui::TextDisabled("the scene has no effects");
        return;
    }
    for (auto& edit : stage.document.effects()) {
        const std::string name =
            edit->file().filename().string() + (edit->isChanged() ? "  (changed)" : "");
        ImGui::PushID(edit->file().c_str());
        if (ImGui::TreeNodeEx((name + "###effect").c_str(), ImGuiTreeNodeFlags_SpanAvailWidth)) {
            showEffect(stage, *edit);
            ImGui::TreePop();
        }
        ImGui::PopID();
    }
}

}  // namespace brume::view
