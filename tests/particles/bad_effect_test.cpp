// SPDX-License-Identifier: Apache-2.0
// Effect files with one fault each, read from disk and set up as for a simulation: every kind of
// fault gives one line that names the file, the place in it, the key and what is allowed.
#include <gtest/gtest.h>
#include <core/error.hpp>
#include <particles/compiled_effect.hpp>
#include <scene/loader.hpp>
#include <volumes/vdb_file.hpp>

#include <unistd.h>
#include <filesystem>
#include <fstream>

namespace brume::particles {
namespace {

struct Fault {
    const char* what;
    const char* text;   // of the file, from its second line on
    const char* place;  // line and column
    const char* key;
    const char* allowed;
};

const Fault kFaults[] = {
    {"unknown module", R"("modules": [ { "type": "gravitas" } ])", "2:14", "gravitas",
     "known are gravity, drag"},
    {"unknown key of a module", R"("modules": [ { "type": "drag", "rat": 1 } ])", "2:39", "'rat'",
     "known are rate, wind"},
    {"unknown key", R"("colour": [1, 0, 0])", "2:1", "\"colour\"", "known are"},
    {"wrong type", R"("tickRate": "fast")", "2:13", "\"tickRate\"", "must be a number"},
    {"wrong type in a module", R"("modules": [ { "type": "drag", "rate": "much" } ])", "2:40",
     "'rate'", "a number allowed"},
    {"negative lifetime", R"("emitters": [ { "lifetime": -2 } ])", "2:29",
     "\"emitters[0].lifetime\"", "must be a number above 0"},
    {"NaN", R"("tickRate": NaN)", "2:13", "", "allowed"},
    {"beyond all numbers", R"("tickRate": 1e999)", "2:17", "\"tickRate\"", "allowed"},
    {"empty curve", R"("overLife": { "radius": [] })", "2:25", "\"overLife.radius\"",
     "must be an array of 1 to 64"},
    {"unsorted curve", R"("overLife": { "density": [[0.5, 1], [0.2, 0]] })", "2:38",
     "\"overLife.density[1][0]\"", "ages must rise"},
    {"missing VDB file",
     R"("modules": [ { "type": "buoyancy", "file": "absent.vdb", "grid": "temperature" } ])",
     "2:44", "absent.vdb", "no such file"},
    {"missing VDB file of an emitter",
     R"("emitters": [ { "lifetime": 1, "shape": { "type": "volume", "file": "absent.vdb", "grid": "d" } } ])",
     "2:69", "absent.vdb", "no such file"},
    {"capacity 0", R"("capacity": 0)", "2:13", "\"capacity\"", "an integer from 1 to 67108864"},
    {"capacity 2^40", R"("capacity": 1099511627776)", "2:13", "\"capacity\"",
     "an integer from 1 to 67108864"},
    {"cyclic sub-emitters", R"("subEmitters": [ { "on": "death", "effect": "bad.effect.json" } ])",
     "2:45", "\"subEmitters[0].effect\"", "leads back to an effect"},
    {"depth collider in world space",
     R"("space": "world", "modules": [ { "type": "collide_depth" } ])", "2:32", "collide_depth",
     "local allowed"},
};

std::string messageOf(const std::filesystem::path& file) {
    try {
        scene::Effect effect = scene::loadEffect(file, Log());
        volumes::loadEffectFields(effect);
        compileEffect(effect);
    } catch (const Error& error) {
        return error.kind() == ErrorKind::Input ? error.what() : "not an input error";
    }
    return "no error";
}

TEST(BadEffectFile, EachKindOfFault_IsOneLineWithFilePlaceKeyAndWhatIsAllowed) {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("brume_bad_effect_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    for (const Fault& fault : kFaults) {
        SCOPED_TRACE(fault.what);
        const std::string text = fault.text;
        const bool hasEmitters = text.find("\"emitters\"") != std::string::npos;
        std::ofstream(folder / "bad.effect.json")
            << "{ \"version\": 1, \"medium\": \"smoke\","
            << (hasEmitters ? "" : " \"emitters\": [ { \"lifetime\": 1 } ],") << "\n"
            << text << " }\n";
        const std::string message = messageOf(folder / "bad.effect.json");
        EXPECT_NE(message.find("bad.effect.json:" + std::string(fault.place) + ":"),
                  std::string::npos)
            << message;
        EXPECT_NE(message.find(fault.key), std::string::npos) << message;
        EXPECT_NE(message.find(fault.allowed), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace brume::particles
