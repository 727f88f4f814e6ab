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
}

}  // namespace

ModuleValues::ModuleValues(const ModuleInfo& info, const scene::ModuleSettings& settings)
    : mWhere(settings.where) {
    for (const ModuleKey& key : info.keys) mValues[key.name] = key.fallback;
    for (const auto& [name, value] : settings.values) {
        const ModuleKey* key = findKey(info, name);
        if (!key) {
            std::vector<std::string> known;
            for (const ModuleKey& k : info.keys) known.push_back(k.name);
            throw inputError(kDoing, mWhere,
                             fmt::format("module '{}' has no key '{}', known are {}", info.name,
                                         name, fmt::join(known, ", ")));
        }
        checkValue(info, *key, value, mWhere);
        mValues[name] = value;
    }
}

dvec3 ModuleValues::vector(const std::string& key) const {
    const std::vector<double>& v = mValues.at(key);
    return {v[0], v[1], v[2]};
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
}

}  // namespace brume::particles
