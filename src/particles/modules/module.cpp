// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <core/error.hpp>
#include <particles/module_list.hpp>
#include <particles/modules/module.hpp>

#include <algorithm>

namespace brume::particles {
namespace {

constexpr const char* kDoing = "setting up the modules of an effect";

const ModuleKey* findKey(const ModuleInfo& info, const std::string& name) {
    const auto found = std::find_if(info.keys.begin(), info.keys.end(),
                                    [&](const ModuleKey& key) { return key.name == name; });
    return found == info.keys.end() ? nullptr : &*found;
}

void checkValue(const ModuleInfo& info, const ModuleKey& key, const std::vector<double>& value,
                const std::string& where) {
    const std::string subject = fmt::format("'{}' of module '{}'", key.name, info.name);
    if (key.isText)
        throw inputError(kDoing, where, fmt::format("{} is a number, a text allowed", subject));
    if (!key.choices.empty())
        throw inputError(kDoing, where,
                         fmt::format("{} is a number, one of {} allowed", subject,
                                     fmt::join(key.choices, ", ")));
    if (value.size() != key.fallback.size())
        throw inputError(kDoing, where,
                         fmt::format("{} has {} numbers, {} allowed", subject, value.size(),
                                     key.fallback.size()));
    for (const double number : value) {
        if (!(number >= key.lo && number <= key.hi))
            throw inputError(kDoing, where,
                             fmt::format("{} is {}, {} to {} {} allowed", subject, number, key.lo,
                                         key.hi, key.unit == "1" ? "" : key.unit));
        if (key.isInteger && number != std::floor(number))
            throw inputError(kDoing, where,
                             fmt::format("{} is {}, whole numbers allowed", subject, number));
    }
    if (key.isDirection && value == std::vector<double>{0, 0, 0})
        throw inputError(kDoing, where,
                         fmt::format("{} is zero, a direction of any length allowed", subject));
}

std::uint32_t findChoice(const ModuleInfo& info, const ModuleKey& key, const std::string& word,
                         const std::string& where) {
    const std::string subject = fmt::format("'{}' of module '{}'", key.name, info.name);
    if (key.choices.empty())
        throw inputError(kDoing, where,
                         fmt::format("{} is a word, {} allowed", subject,
                                     key.fallback.size() == 1 ? "a number" : "an array of three"));
    const auto found = std::find(key.choices.begin(), key.choices.end(), word);
    if (found == key.choices.end())
        throw inputError(kDoing, where,
                         fmt::format("{} is '{}', one of {} allowed", subject, word,
                                     fmt::join(key.choices, ", ")));
    return static_cast<std::uint32_t>(found - key.choices.begin());
}

/// The place of a key's value, or that of the module.
std::string placeOf(const scene::ModuleSettings& settings, const std::string& key) {
    const auto found = settings.whereOf.find(key);
    return found == settings.whereOf.end() ? settings.where : found->second;
}

const ModuleKey& requireKey(const ModuleInfo& info, const std::string& name,
                            const std::string& where) {
    if (const ModuleKey* key = findKey(info, name)) return *key;
    std::vector<std::string> known;
    for (const ModuleKey& k : info.keys) known.push_back(k.name);
    throw inputError(kDoing, where,
                     fmt::format("module '{}' has no key '{}', known are {}", info.name, name,
                                 fmt::join(known, ", ")));
}

}  // namespace

ModuleValues::ModuleValues(const ModuleInfo& info, const scene::ModuleSettings& settings)
    : mWhere(settings.where) {
    for (const ModuleKey& key : info.keys) {
        if (key.isText && !settings.texts.contains(key.name))
            throw inputError(kDoing, settings.values.contains(key.name)
                                         ? placeOf(settings, key.name)
                                         : mWhere,
                             fmt::format("module '{}' needs a text '{}'", info.name, key.name));
        if (key.isText)
            mTexts[key.name] = settings.texts.at(key.name);
        else if (key.choices.empty())
            set(info, key, key.fallback, mWhere);
        else
            mChoices[key.name] = 0;
    }
    if (mTexts.contains("file")) mFileWhere = placeOf(settings, "file");
    for (const auto& [name, value] : settings.values) {
        const std::string where = placeOf(settings, name);
        set(info, requireKey(info, name, where), value, where);
    }
    for (const auto& [name, word] : settings.texts) {
        const std::string where = placeOf(settings, name);
        const ModuleKey& key = requireKey(info, name, where);
        if (!key.isText) mChoices[name] = findChoice(info, key, word, where);
    }
}

void ModuleValues::set(const ModuleInfo& info, const ModuleKey& key,
                       const std::vector<double>& value, const std::string& where) {
    checkValue(info, key, value, where);
    std::vector<double>& stored = mValues[key.name];
    stored = value;
    if (!key.isDirection) return;
    // Through the largest component, so that no square is lost.
    const double largest = std::max({std::abs(value[0]), std::abs(value[1]), std::abs(value[2])});
    const dvec3 unit = glm::normalize(dvec3(value[0], value[1], value[2]) / largest);
    stored = {unit.x, unit.y, unit.z};
}

scene::FieldPlacement ModuleValues::field() const {
    return {.source = {text("file"), text("grid"), static_cast<int>(number("gridIndex"))},
            .position = vector("position"),
            .scale = number("scale"),
            .where = mFileWhere};
}

std::vector<ModuleKey> withFieldKeys(std::vector<ModuleKey> keys) {
    keys.insert(keys.begin(),
                {{.name = "file", .unit = "text", .summary = "a .vdb file", .isText = true},
                 {.name = "grid", .unit = "text", .summary = "name of the grid", .isText = true},
                 {.name = "gridIndex",
                  .unit = "1",
                  .summary = "which of several grids of that name; -1: the only one",
                  .fallback = {-1},
                  .lo = -1,
                  .hi = 1e6,
                  .isInteger = true},
                 {.name = "position",
                  .unit = "m",
                  .summary = "of the file's origin",
                  .fallback = {0, 0, 0},
                  .lo = -1e6,
                  .hi = 1e6},
                 {.name = "scale",
                  .unit = "1",
                  .summary = "of the file's lengths",
                  .fallback = {1},
                  .lo = 1e-6,
                  .hi = 1e6}});
    return keys;
}

dvec3 ModuleValues::vector(const std::string& key) const {
    const std::vector<double>& v = mValues.at(key);
    return {v[0], v[1], v[2]};
}

void checkModuleCount(const ModuleValues& values, const char* kind, std::uint32_t count) {
    if (count < shader::kMaxModulesPerType) return;
    throw inputError(
        kDoing, values.where(),
        fmt::format("one {} too many, at most {} allowed", kind, shader::kMaxModulesPerType));
}

void makeFrame(const dvec3& axis, dvec3& tangent, dvec3& bitangent) {
    // The axis' smallest component gives the safest cross product.
    const dvec3 a = glm::abs(axis);
    const dvec3 helper = a.x <= a.y && a.x <= a.z ? dvec3(1, 0, 0)
                         : a.y <= a.z             ? dvec3(0, 1, 0)
                                                  : dvec3(0, 0, 1);
    tangent = glm::normalize(glm::cross(helper, axis));
    bitangent = glm::cross(axis, tangent);
}

const std::vector<Module>& modules() {
    static const std::vector<Module> all = makeModuleList();
    return all;
}

void addModules(const std::vector<scene::ModuleSettings>& settings, ModuleSums& sums) {
    for (const scene::ModuleSettings& one : settings) {
        const auto found = std::find_if(modules().begin(), modules().end(),
                                        [&](const Module& m) { return m.info.name == one.type; });
        if (found == modules().end()) {
            std::vector<std::string> known;
            for (const Module& m : modules()) known.push_back(m.info.name);
            throw inputError(kDoing, one.where,
                             fmt::format("there is no module '{}', known are {}", one.type,
                                         fmt::join(known, ", ")));
        }
        found->add(ModuleValues(found->info, one), sums);
    }
    // Rates of drag become shares of their sum.
    for (std::uint32_t i = 0; i < sums.parameters->velocityFieldCount; ++i)
        if (sums.dragRate > 0)
            sums.parameters->velocityField[i].weight /= static_cast<float>(sums.dragRate);
    for (std::uint32_t i = 0; i < sums.parameters->vortexCount; ++i)
        if (sums.dragRate > 0)
            sums.parameters->vortex[i].weight /= static_cast<float>(sums.dragRate);
}

}  // namespace brume::particles
