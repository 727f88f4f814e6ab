// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <core/error.hpp>
#include <particles/compiled_effect.hpp>
#include <particles/modules/module.hpp>

#include "effects.hpp"

#include <fstream>
#include <iterator>

namespace brume::particles {
namespace {

std::string messageOf(const scene::ModuleSettings& settings) {
    scene::Effect effect = burstEffect(1);
    effect.modules = {settings};
    addTestFields(effect);
    try {
        compileEffect(effect);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Input);
        return error.what();
    }
    return "no error";
}

TEST(Modules, Registry_IsCompleteAndItsDefaultsAreAllowed) {
    ASSERT_GE(modules().size(), 3u);
    for (const Module& module : modules()) {
        EXPECT_FALSE(module.info.name.empty());
        EXPECT_FALSE(module.info.summary.empty()) << module.info.name;
        scene::ModuleSettings settings = moduleSettings(module.info.name);
        for (const ModuleKey& key : module.info.keys) {
            EXPECT_FALSE(key.unit.empty() || key.summary.empty()) << module.info.name << key.name;
            if (key.isText) {
                settings.texts["file"] = "test.vdb";
                settings.texts["grid"] = module.info.name == "velocity_field" ? "velocity"
                                         : module.info.name == "buoyancy"     ? "temperature"
                                                                              : "ball";
                continue;
            }
            if (!key.choices.empty()) {
                settings.texts[key.name] = key.choices[0];
                continue;
            }
            EXPECT_TRUE(key.fallback.size() == 1 || key.fallback.size() == 3);
            settings.values[key.name] = key.fallback;
        }
        EXPECT_EQ(messageOf(settings), "no error") << module.info.name;
    }
}

TEST(Modules, Documentation_NamesEveryKeyWithItsUnit) {
    std::ifstream file(BRUME_SOURCE_DIR "/docs/particles.md");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    for (const Module& module : modules())
        for (const ModuleKey& key : module.info.keys)
            EXPECT_NE(
                text.find("| `" + module.info.name + "` | `" + key.name + "` | " + key.unit + " |"),
                std::string::npos)
                << module.info.name << "." << key.name;
}

TEST(Modules, UnknownModule_ListsTheKnownOnes) {
    EXPECT_EQ(messageOf(moduleSettings("gravitation")),
              "setting up the modules of an effect: test.effect.json:3:5: there is no module "
              "'gravitation', known are gravity, drag, quadratic_drag, curl_noise, vortex, attractor, "
              "velocity_field, buoyancy, collide_plane, collide_sphere, collide_box, "
              "collide_capsule, collide_level_set, collide_depth, kill_plane, kill_sphere, kill_box");
}

TEST(Modules, UnknownKey_ListsTheKnownOnes) {
    EXPECT_EQ(messageOf(moduleSettings("drag", {{"rat", {1}}})),
              "setting up the modules of an effect: test.effect.json:3:5: module 'drag' has no key "
              "'rat', known are rate, wind");
}

TEST(Modules, WrongValues_AreRefused) {
    const auto contains = [](const scene::ModuleSettings& settings, const std::string& part) {
        const std::string message = messageOf(settings);
        EXPECT_NE(message.find(part), std::string::npos) << message;
    };
    contains(moduleSettings("gravity", {{"acceleration", {1}}}), "has 1 numbers, 3 allowed");
    contains(moduleSettings("drag", {{"rate", {1, 2, 3}}}), "has 3 numbers, 1 allowed");
    contains(moduleSettings("drag", {{"rate", {-1}}}), "'rate' of module 'drag' is -1");
    contains(moduleSettings("drag", {{"rate", {std::nan("")}}}), "is nan");
    contains(moduleSettings("curl_noise", {{"octaves", {1.5}}}), "whole numbers allowed");
    contains(moduleSettings("vortex", {{"axis", {0, 0, 0}}}), "'axis' of module 'vortex' is zero");
    scene::ModuleSettings words = moduleSettings("collide_plane");
    words.texts["response"] = "explode";
    words.whereOf["response"] = "test.effect.json:4:9";
    contains(words, "test.effect.json:4:9: 'response' of module 'collide_plane' is 'explode', one "
                    "of bounce, stick, kill allowed");
    words.texts = {{"friction", "high"}};
    contains(words, "'friction' of module 'collide_plane' is a word, a number allowed");
    contains(moduleSettings("collide_plane", {{"response", {1}}}),
             "'response' of module 'collide_plane' is a number, one of bounce");
    contains(moduleSettings("buoyancy"), "module 'buoyancy' needs a text 'file'");
    contains(fieldModule("buoyancy", "velocity"), "has values of 3 components, 1 allowed");
    contains(fieldModule("buoyancy", "heat"), "test.vdb: grid \"heat\" is not loaded");
    contains(fieldModule("collide_level_set", "density"), "the grid is no level set");
    contains(moduleSettings("collide_capsule", {{"to", {0, 0, 0}}}), "are the same place");
    contains(moduleSettings("curl_noise", {{"scale", {0}}}), "'scale' of module 'curl_noise' is 0");
}

TEST(Modules, OneModuleTooMany_IsRefused) {
    scene::Effect effect = burstEffect(1);
    effect.modules.assign(shader::kMaxModulesPerType, moduleSettings("curl_noise"));
    EXPECT_NO_THROW(compileEffect(effect));
    effect.modules.push_back(moduleSettings("curl_noise"));
    EXPECT_THROW(compileEffect(effect), Error);
}

TEST(Modules, TwoDrags_AddTheirRatesAndWeightTheirWinds) {
    scene::Effect effect = burstEffect(1);
    effect.modules = {moduleSettings("drag", {{"rate", {1}}, {"wind", {4, 0, 0}}}),
                      moduleSettings("drag", {{"rate", {3}}, {"wind", {0, 4, 0}}})};
    const CompiledEffect compiled = compileEffect(effect)[0];
    EXPECT_FLOAT_EQ(compiled.parameters.step.dragPerTick, static_cast<float>(4.0 / 120));
    EXPECT_EQ(compiled.parameters.step.wind, vec3(1, 3, 0));
}

}  // namespace
}  // namespace brume::particles
