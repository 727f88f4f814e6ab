// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <app/commands/list.hpp>
#include <bench/scenes.hpp>
#include <core/error.hpp>
#include <filesystem>
#include <gpu/device.hpp>
#include <map>
#include <oit/method_info.hpp>
#include <particles/modules/module.hpp>
#include <shadows/store_info.hpp>
#include <vector>

namespace brume::app {
namespace {

std::string_view describe(oit::Exactness exactness) {
    switch (exactness) {
        case oit::Exactness::Exact:
            return "exact";
        case oit::Exactness::Bounded:
            return "bounded";
        case oit::Exactness::Approximate:
            break;
    }
    return "approximate";
}

std::string joinWeaknesses(const oit::MethodInfo& method) {
    std::vector<std::string_view> words;
    for (const oit::Weakness weakness : method.weaknesses) words.push_back(describe(weakness));
    return fmt::format("{}", fmt::join(words, ", "));
}

void listMethods() {
    for (const oit::MethodInfo& m : oit::listMethods()) {
        fmt::print("{:<16} {} ({})\n", m.name, m.summary, describe(m.exactness));
        fmt::print("  paper   {}\n  passes  {}\n  bytes   {} per pixel\n  limits  {}\n", m.paper,
                   m.passes, m.bytesPerPixel, m.limits);
        if (!m.weaknesses.empty()) fmt::print("  may err {}\n", joinWeaknesses(m));
        for (const oit::SettingInfo& s : m.settings)
            fmt::print("  --set {}={} ({}): {}\n", s.name, s.defaultValue, s.values, s.meaning);
    }
    fmt::print("{:<16} The exact renderer on the CPU, in double precision (exact)\n", "reference");
}

void listMethodsAsMarkdown() {
    fmt::print("| method | what it does | result | passes | bytes per pixel | limits | paper |\n");
    fmt::print("|---|---|---|---|---|---|---|\n");
    for (const oit::MethodInfo& m : oit::listMethods())
        fmt::print("| `{}` | {} | {} | {} | {} | {} | {} |\n", m.name, m.summary,
                   describe(m.exactness), m.passes, m.bytesPerPixel, m.limits, m.paper);
}

void listSettings(std::span<const scene::SettingInfo> settings) {
    for (const scene::SettingInfo& s : settings)
        fmt::print("  shadow.{}={} ({}): {}\n", s.name, s.defaultValue, s.values, s.meaning);
}

void listShadows() {
    for (const shadows::StoreInfo& store : shadows::listStores()) {
        fmt::print("{:<16} {}\n  paper   {}\n  result  {}\n  bytes   {} per texel\n  limits  {}\n",
                   store.name, store.summary, store.paper, store.result, store.bytesPerTexel,
                   store.limits);
        listSettings(store.settings);
    }
    fmt::print("{:<16} Lights shine through everything\n", "none");
    fmt::print("settings of every map (--set, or shadowSettings of a light without \"shadow.\")\n");
    listSettings(shadows::listMapSettings());
}

std::string formatFallback(const particles::ModuleKey& key) {
    if (key.isText) return "required";
    if (!key.choices.empty()) return key.choices[0];
    if (key.fallback.size() == 1) return fmt::format("{}", key.fallback[0]);
    return fmt::format("[{}, {}, {}]", key.fallback[0], key.fallback[1], key.fallback[2]);
}

std::string formatAllowed(const particles::ModuleKey& key) {
    if (key.isText) return "any";
    if (!key.choices.empty()) return fmt::format("{}", fmt::join(key.choices, ", "));
    return fmt::format("{} to {}", key.lo, key.hi);
}

void listModules() {
    for (const particles::Module& module : particles::modules()) {
        fmt::print("{:<16} {}{}\n", module.info.name, module.info.summary,
                   module.info.isReplayable ? "" : " (not replayable)");
        for (const particles::ModuleKey& key : module.info.keys)
            fmt::print("  {} = {} ({}; {}): {}\n", key.name, formatFallback(key),
                       formatAllowed(key), key.unit, key.summary);
    }
}

void listModulesAsMarkdown() {
    fmt::print("| module | key | unit | default | allowed | |\n|---|---|---|---|---|---|\n");
    for (const particles::Module& module : particles::modules())
        for (const particles::ModuleKey& key : module.info.keys)
            fmt::print("| `{}` | `{}` | {} | {} | {} | {} |\n", module.info.name, key.name,
                       key.unit, formatFallback(key), formatAllowed(key), key.summary);
}

void listDevices() {
    int index = 0;
    for (const gpu::DeviceInfo& device : gpu::listDevices()) {
        fmt::print("{} {} ({}), driver {}, Vulkan {}{}\n", index++, device.name, device.type,
                   device.driver, device.api, device.rejections.empty() ? "" : ": cannot be used");
        for (const std::string& reason : device.rejections) fmt::print("  {}\n", reason);
    }
    if (index == 0) fmt::print("no Vulkan device\n");
}

void listScenes() {
    for (const bench::SceneInfo& scene : bench::listScenes())
        fmt::print("{:<16} {}\n", scene.name, scene.summary);
    std::error_code error;
    std::vector<std::filesystem::path> demos;
    for (const auto& entry : std::filesystem::directory_iterator("demos", error))
        if (std::filesystem::exists(entry.path() / "scene.json", error))
            demos.push_back(entry.path());
    std::sort(demos.begin(), demos.end());
    for (const auto& demo : demos)
        fmt::print("{:<16} {}\n", demo.filename().string(), (demo / "scene.json").string());
}

}  // namespace

void runList(const ListArguments& arguments, const Log&) {
    if (arguments.markdown && arguments.what != "methods" && arguments.what != "modules")
        throw inputError("reading options", "--markdown",
                         "only allowed with list methods and list modules");
    if (arguments.what == "methods") arguments.markdown ? listMethodsAsMarkdown() : listMethods();
    if (arguments.what == "shadows") listShadows();
    if (arguments.what == "modules") arguments.markdown ? listModulesAsMarkdown() : listModules();
    if (arguments.what == "devices") listDevices();
    if (arguments.what == "scenes") listScenes();
}

}  // namespace brume::app
