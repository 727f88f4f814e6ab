// SPDX-License-Identifier: Apache-2.0
// Method, shadow store and their settings, all from what they say about themselves.
#include <view/panels/panels.hpp>
#include <view/setting_range.hpp>

#include <oit/method_info.hpp>
#include <shadows/store_info.hpp>

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace brume::view {
namespace {

const oit::MethodInfo* findMethod(const std::string& name) {
    for (const oit::MethodInfo& info : oit::listMethods())
        if (info.name == name) return &info;
    return nullptr;
}

const char* describe(oit::Exactness exactness) {
    switch (exactness) {
        case oit::Exactness::Exact:
            return "exact";
        case oit::Exactness::Bounded:
            return "within a stated bound";
        case oit::Exactness::Approximate:
            break;
    }
    return "approximate";
}

std::string explainMethod(const oit::MethodInfo& info) {
    return fmt::format("{}\n\nResult: {}\nLimits: {}\nPasses: {}\nBytes per pixel: {}\nPaper: {}",
                       info.summary, describe(info.exactness), info.limits, info.passes,
                       info.bytesPerPixel, info.paper);
}

bool editChoice(const SettingRange& range, std::string& value) {
    bool isChanged = false;
    if (!ImGui::BeginCombo("##value", value.c_str())) return false;
    for (const std::string& choice : range.choices)
        if (ImGui::Selectable(choice.c_str(), choice == value)) {
            value = choice;
            isChanged = true;
        }
    ImGui::EndCombo();
    return isChanged;
}

bool editNumber(const SettingRange& range, std::string& value) {
    double number = leadingNumber(value).value_or(std::isfinite(range.lo) ? range.lo : 0);
    const double span = std::isfinite(range.hi) ? range.hi - range.lo : 10;
    const auto step = static_cast<float>(range.isWhole  ? 0.2
                                         : range.isWide ? 0.01 * std::max(std::abs(number), 1e-3)
                                                        : span / 300);
    const std::string unit = range.unit.empty() ? "" : " " + range.unit;
    const std::string format = (range.isWhole ? "%.0f" : "%.6g") + unit;
    if (!ImGui::DragScalar("##value", ImGuiDataType_Double, &number, step, &range.lo, &range.hi,
                           format.c_str(), ImGuiSliderFlags_AlwaysClamp))
        return false;
    value = formatNumber(range.isWhole ? std::round(number) : number);
    return true;
}

bool editText(std::string& value) {
    char text[256] = {};
    std::strncpy(text, value.c_str(), sizeof(text) - 1);
    if (!ImGui::InputText("##value", text, sizeof(text), ImGuiInputTextFlags_EnterReturnsTrue))
        return false;
    value = text;
    return true;
}

/// One row: the name, a widget for what it may be, and a way back to the default.
void showSetting(const scene::SettingInfo& info, const std::string& prefix,
                 scene::Settings& settings) {
    const std::string key = prefix + std::string(info.name);
    const auto found = settings.find(key);
    std::string value = found == settings.end() ? std::string(info.defaultValue) : found->second;
    const SettingRange range = readRange(info);
    ImGui::PushID(key.c_str());
    ImGui::AlignTextToFramePadding();
    if (found == settings.end())
        ImGui::TextDisabled("%s", std::string(info.name).c_str());
    else
        ImGui::TextUnformatted(std::string(info.name).c_str());
    explain(fmt::format("{}\n\nAllowed: {}\nDefault: {}", info.meaning, info.values,
                        info.defaultValue));
    ImGui::SameLine(9.5f * ImGui::GetFontSize());
    ImGui::SetNextItemWidth(-2 * ImGui::GetFrameHeight());
    bool isChanged = false;
    if (range.kind == SettingRange::Kind::Flag) {
        bool isOn = value == "true";
        isChanged = ImGui::Checkbox("##value", &isOn);
        value = isOn ? "true" : "false";
    } else if (range.kind == SettingRange::Kind::Choice) {
        isChanged = editChoice(range, value);
    } else if (range.kind == SettingRange::Kind::Number) {
        isChanged = editNumber(range, value);
    } else {
        isChanged = editText(value);
    }
    if (isChanged) settings[key] = value;
    if (found != settings.end()) {
        ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::GetFrameHeight());
        if (ImGui::SmallButton("x")) settings.erase(key);
        explain("Back to the default");
    }
    ImGui::PopID();
}

void showMethods(PaneChoice& choice) {
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##method", choice.method.c_str(), ImGuiComboFlags_HeightLarge)) {
        for (const oit::MethodInfo& info : oit::listMethods()) {
            const std::string name(info.name);
            if (ImGui::Selectable(name.c_str(), name == choice.method) && name != choice.method) {
                choice.method = name;
                // They belong to the method; those of the shadow maps stay.
                std::erase_if(choice.settings, [](const auto& setting) {
                    return !setting.first.starts_with("shadow.");
                });
            }
            explain(explainMethod(info));
        }
        ImGui::EndCombo();
    }
    const oit::MethodInfo* info = findMethod(choice.method);
    if (!info) return;
    explain(explainMethod(*info));
    ImGui::PushTextWrapPos(0);
    ImGui::TextDisabled("%s: %s", describe(info->exactness), std::string(info->summary).c_str());
    ImGui::PopTextWrapPos();
    for (const scene::SettingInfo& setting : info->settings)
        showSetting(setting, "", choice.settings);
}

void showShadows(const Stage& stage, PaneChoice& choice) {
    const auto dropSettings = [&] {
        std::erase_if(choice.settings,
                      [](const auto& setting) { return setting.first.starts_with("shadow."); });
    };
    const auto offer = [&](const std::string& name, const std::string& label) {
        if (ImGui::Selectable(label.c_str(), name == choice.shadow) && name != choice.shadow) {
            choice.shadow = name;
            dropSettings();
        }
    };
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("shadows");
    ImGui::SameLine(5.5f * ImGui::GetFontSize());
    ImGui::SetNextItemWidth(-1);
    const char* const kScene = "as the scene says";
    if (ImGui::BeginCombo("##shadow", choice.shadow.empty() ? kScene : choice.shadow.c_str(),
                          ImGuiComboFlags_HeightLarge)) {
        offer("", kScene);
        offer("none", "none");
        for (const shadows::StoreInfo& store : shadows::listStores()) {
            offer(std::string(store.name), std::string(store.name));
            explain(fmt::format("{}\n\nResult: {}\nLimits: {}\nBytes per texel: {}\nPaper: {}",
                                store.summary, store.result, store.limits, store.bytesPerTexel,
                                store.paper));
        }
        ImGui::EndCombo();
    }
    const auto& lights = stage.document.prepared().scene.lights;
    const bool hasOwn = std::any_of(lights.begin(), lights.end(),
                                    [](const scene::Light& light) { return light.shadow != "none"; });
    if (choice.shadow == "none" || (choice.shadow.empty() && !hasOwn)) return;
    for (const shadows::StoreInfo& store : shadows::listStores())
        if (store.name == choice.shadow)
            for (const scene::SettingInfo& setting : store.settings)
                showSetting(setting, "shadow.", choice.settings);
    if (!ImGui::TreeNodeEx("shadow maps", ImGuiTreeNodeFlags_SpanAvailWidth)) return;
    for (const scene::SettingInfo& setting : shadows::listMapSettings())
        showSetting(setting, "shadow.", choice.settings);
    ImGui::TreePop();
}

}  // namespace

void showChoice(Stage& stage, std::size_t index) {
    ImGui::PushID(static_cast<int>(index));
    showMethods(stage.choices[index]);
    ImGui::Spacing();
    showShadows(stage, stage.choices[index]);
    ImGui::PopID();
}

}  // namespace brume::view
