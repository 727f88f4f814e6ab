// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <particles/modules/module.hpp>
#include <scene/loader.hpp>
#include <view/effect_edit.hpp>

#include <fmt/format.h>

#include <fstream>

namespace brume::view {
namespace {

using nlohmann::json;

std::string readFile(const std::filesystem::path& file) {
    return scene::JsonDocument::readText({.doing = "loading effect", .name = file.string()});
}

const json& schema() {
    static const json parsed = json::parse(scene::effectSchema());
    return parsed;
}

std::vector<double> readNumbers(const json& value) {
    if (value.is_number()) return {value.get<double>()};
    std::vector<double> numbers;
    if (value.is_array() && value.size() <= 3)
        for (const json& item : value)
            if (item.is_number()) numbers.push_back(item.get<double>());
    return numbers.size() == value.size() ? numbers : std::vector<double>();
}

/// A number, a pair [low, high] or a word of the schema; false for what has a shape of its own.
bool describe(const json& rule, const json* value, EffectKey& key) {
    constexpr double kUnlimited = 1e9;
    key.summary = rule.value("description", "");
    if (rule.contains("enum")) {
        for (const json& word : rule["enum"]) key.choices.push_back(word.get<std::string>());
        key.word = value && value->is_string() ? value->get<std::string>()
                                               : rule.value("default", key.choices[0]);
        return true;
    }
    const json* number = &rule;
    if (rule.contains("anyOf")) {
        number = &rule["anyOf"][0];
        key.isPair = true;
    }
    const std::string type = number->value("type", "");
    if (type != "number" && type != "integer") return false;
    key.isInteger = type == "integer";
    key.lo = number->value("minimum", number->contains("exclusiveMinimum") ? 0.0 : -kUnlimited);
    key.hi = number->value("maximum", kUnlimited);
    if (value)
        key.values = readNumbers(*value);
    else if (rule.contains("default"))
        key.values = readNumbers(rule["default"]);
    if (key.isPair && key.values.size() == 1) key.values.push_back(key.values[0]);
    return !key.values.empty() && key.values.size() <= 2;
}

EffectGroup groupOf(const json& rules, const json& object, const std::string& pointer) {
    EffectGroup group;
    for (const auto& [name, rule] : rules.items()) {
        EffectKey key{.pointer = pointer + "/" + name, .name = name};
        const auto found = object.find(name);
        if (describe(rule, found == object.end() ? nullptr : &*found, key))
            group.keys.push_back(std::move(key));
    }
    return group;
}

EffectGroup groupOf(const particles::ModuleInfo& info, const json& module,
                    const std::string& pointer) {
    EffectGroup group{info.name, info.summary, {}};
    for (const particles::ModuleKey& known : info.keys) {
        if (known.isText) continue;  // names of files are no matter of dragging
        EffectKey key{.pointer = pointer + "/" + known.name,
                      .name = known.name,
                      .unit = known.unit == "1" || known.unit == "word" ? "" : known.unit,
                      .summary = known.summary,
                      .values = known.fallback,
                      .lo = known.lo,
                      .hi = known.hi,
                      .isInteger = known.isInteger,
                      .choices = known.choices};
        const auto found = module.find(known.name);
        if (!known.choices.empty()) {
            key.values.clear();
            key.word = found != module.end() ? found->get<std::string>() : known.choices[0];
        } else if (found != module.end()) {
            key.values = readNumbers(*found);
        }
        group.keys.push_back(std::move(key));
    }
    return group;
}

}  // namespace

EffectEdit::EffectEdit(std::filesystem::path file)
    : mFile(std::move(file)) {
    reload();
}

std::vector<EffectGroup> EffectEdit::groups() const {
    const json& root = mText->root();
    std::vector<EffectGroup> groups;
    if (!root.is_object()) return groups;
    groups.push_back(groupOf(schema()["properties"], root, ""));
    groups.back().title = "effect";
    const json& emitterRules = schema()["definitions"]["emitter"]["properties"];
    std::size_t i = 0;
    for (const json& emitter : root.value("emitters", json::array())) {
        groups.push_back(groupOf(emitterRules, emitter, fmt::format("/emitters/{}", i)));
        groups.back().title = fmt::format("emitter {}", ++i);
    }
    i = 0;
    for (const json& module : root.value("modules", json::array())) {
        const std::string pointer = fmt::format("/modules/{}", i++);
        for (const particles::Module& known : particles::modules())
            if (module.value("type", "") == known.info.name)
                groups.push_back(groupOf(known.info, module, pointer));
    }
    return groups;
}

void EffectEdit::set(const EffectKey& key) {
    json value = json::array();
    if (!key.choices.empty()) {
        value = key.word;
    } else {
        for (const double number : key.values)
            value.push_back(key.isInteger ? json(static_cast<std::int64_t>(number)) : json(number));
        const bool isSingle = value.size() == 1 || (key.isPair && value[0] == value[1]);
        if (isSingle) value = json(value[0]);
    }
    auto changed = std::make_shared<JsonText>(mText->text(), mFile.string());
    changed->set(key.pointer, value);
    // What the loader refuses is not taken over.
    scene::parseEffect(changed->text(), mFile, {});
    mText = std::move(changed);
}

void EffectEdit::save() {
    constexpr const char* kDoing = "saving effect";
    std::filesystem::path part = mFile;
    part += ".part";
    std::ofstream stream(part, std::ios::binary);
    stream << text();
    stream.close();
    std::error_code error;
    if (stream) std::filesystem::rename(part, mFile, error);
    if (!stream || error) {
        std::error_code ignored;
        std::filesystem::remove(part, ignored);
        throw failure(kDoing, mFile.string(), error ? error.message() : "it cannot be written");
    }
    mSaved = text();
}

void EffectEdit::reload() {
    mText = std::make_shared<JsonText>(readFile(mFile), mFile.string());
    mSaved = text();
}

}  // namespace brume::view
