// SPDX-License-Identifier: Apache-2.0
#include "scene_test_util.hpp"

#include <scene/loader.hpp>

namespace brume::scene {
namespace {

using test::messageOf;

Effect parse(const std::string& text) { return parseEffect(text, "e.json", Log()); }
std::string parseMessage(const std::string& text) {
    return messageOf([&] { parse(text); });
}
std::string withEmitter(const std::string& keys) {
    return "{\"version\":1,\"medium\":\"m\",\"emitters\":[{\"lifetime\":1," + keys + "}]}";
}

TEST(Effect_AllKeys, DocumentedExample_IsReadInFull) {
    const Effect effect =
        parse(R"({ "version": 1, "capacity": 100000, "tickRate": 60, "medium": "smoke",
      "emitters": [ { "rate": 2000, "bursts": [ { "time": 0.5, "count": 500 } ], "duration": 5,
                      "shape": { "type": "sphere", "radius": 0.2, "position": [1, 2, 3] },
                      "speed": [0.5,1], "direction": [0,2,0], "spread": 20, "lifetime": [2,4] } ],
      "modules": [ { "type": "gravity", "acceleration": [0,-9.81,0] },
                   { "type": "drag", "rate": 0.5, "wind": [1,0,0], "mode": "exact", "on": true } ],
      "overLife": { "radius": [[0,0.05],[1,0.3]], "density": [[0,1],[1,0]],
                    "tint": [[0,[1,1,1]],[1,[0.5,0.25,0]]] }, "profile": "smooth",
        "shadowing": "sample" })");
    EXPECT_EQ(effect.capacity, 100000u);
    EXPECT_EQ(effect.tickRate, 60);
    EXPECT_EQ(effect.medium, "smoke");
    EXPECT_TRUE(effect.smoothProfile);
    EXPECT_EQ(effect.shadowing, Shadowing::Sample);
    ASSERT_EQ(effect.emitters.size(), 1u);
    const Emitter& e = effect.emitters[0];
    EXPECT_EQ(e.rate, 2000);
    ASSERT_EQ(e.bursts.size(), 1u);
    EXPECT_EQ(e.bursts[0].time, 0.5);
    EXPECT_EQ(e.bursts[0].count, 500u);
    EXPECT_EQ(e.duration, 5);
    EXPECT_EQ(e.shape, EmitterShape::Sphere);
    EXPECT_EQ(e.radius, 0.2);
    EXPECT_EQ(e.position, dvec3(1, 2, 3));
    EXPECT_EQ(e.speed, dvec2(0.5, 1));
    EXPECT_EQ(e.direction, dvec3(0, 1, 0));
    EXPECT_NEAR(e.spread, radians(20), 1e-15);
    EXPECT_EQ(e.lifetime, dvec2(2, 4));
    ASSERT_EQ(effect.modules.size(), 2u);
    EXPECT_EQ(effect.modules[0].type, "gravity");
    EXPECT_EQ(effect.modules[0].values.at("acceleration"), (std::vector<double>{0, -9.81, 0}));
    EXPECT_EQ(effect.modules[1].values.at("rate"), std::vector<double>{0.5});
    EXPECT_EQ(effect.modules[1].values.at("on"), std::vector<double>{1});
    EXPECT_EQ(effect.modules[1].texts.at("mode"), "exact");
    EXPECT_EQ(effect.modules[1].where, "e.json:6:20");
    EXPECT_EQ(effect.modules[1].whereOf.at("rate"), "e.json:6:46");
    EXPECT_EQ(effect.radius.keys.size(), 2u);
    EXPECT_EQ(effect.radius.keys[1].second, 0.3);
    EXPECT_EQ(effect.density.keys[1], (std::pair<double, double>(1, 0)));
    EXPECT_EQ(effect.tint.keys[1].second, dvec3(0.5, 0.25, 0));
}

TEST(Effect_Shapes, EachType_ReadsItsKeys) {
    EXPECT_EQ(
        parse(withEmitter(R"("shape":{"type":"point","position":[1,0,0]})")).emitters[0].position,
        dvec3(1, 0, 0));
    EXPECT_EQ(parse(withEmitter(R"("shape":{"type":"box","size":[1,2,3]})")).emitters[0].size,
              dvec3(1, 2, 3));
    const Emitter disc =
        parse(withEmitter(R"("shape":{"type":"disc","radius":2,"normal":[3,0,0]})")).emitters[0];
    EXPECT_EQ(disc.shape, EmitterShape::Disc);
    EXPECT_EQ(disc.normal, dvec3(1, 0, 0));
    EXPECT_EQ(disc.radius, 2);
}

TEST(Effect_Shapes, NewerKeys_AreRead) {
    const auto emitter = [](const std::string& keys) { return parse(withEmitter(keys)).emitters[0]; };
    const Emitter line = emitter(R"("shape":{"type":"line","from":[1,0,0],"to":[1,2,0]})");
    EXPECT_EQ(line.position, dvec3(1, 0, 0));
    EXPECT_EQ(line.size, dvec3(0, 2, 0));
    const Emitter cone = emitter(
        R"("shape":{"type":"cone","radius":1,"height":2,"births":"surface"},"velocity":"normal")");
    EXPECT_EQ(cone.shape, EmitterShape::Cone);
    EXPECT_EQ(cone.height, 2);
    EXPECT_TRUE(cone.fromSurface);
    EXPECT_EQ(cone.velocity, EmitterVelocity::Normal);
    const Emitter moving = emitter(
        R"("delay":2,"inherit":0.5,"path":[[0,[0,0,0]],[3,[1,2,3]]],"bursts":[{"time":1,"count":2,"repeat":9,"interval":0.5}])");
    EXPECT_EQ(moving.delay, 2);
    EXPECT_EQ(moving.inherit, 0.5);
    ASSERT_EQ(moving.path.size(), 2u);
    EXPECT_EQ(moving.path[1].second, dvec3(1, 2, 3));
    EXPECT_EQ(moving.bursts[0].repeat, 9u);
    EXPECT_EQ(moving.bursts[0].interval, 0.5);
}

TEST(Effect_Curves, TemperatureAndSpeed_AreRead) {
    const Effect effect = parse(R"({"version":1,"medium":"m","emitters":[],
        "overLife":{"temperature":[[0,1800],[1,1000]]},"bySpeed":{"radius":[[0,1],[5,2]]}})");
    EXPECT_EQ(effect.temperature.keys[1].second, 1000);
    EXPECT_EQ(effect.radiusBySpeed.keys[1], (std::pair<double, double>(5, 2)));
    EXPECT_TRUE(effect.densityBySpeed.keys.empty());
}

TEST(Effect_Errors, NewerFaults_AreNamedAtTheirPlaces) {
    const std::string start = "loading effect: e.json:1:";
    EXPECT_EQ(parseMessage(withEmitter("\"path\":[[1,[0,0,0]],[1,[0,0,0]]]")),
              start +
                  "74: key \"emitters[0].path[1][0]\": is not above the time before it, times must "
                  "rise");
    EXPECT_EQ(parseMessage(withEmitter(
                  "\"shape\":{\"type\":\"disc\",\"radius\":1,\"innerRadius\":2}")),
              start +
                  "101: key \"emitters[0].shape.innerRadius\": is above 'radius', at most that is "
                  "allowed");
    EXPECT_NE(parseMessage(withEmitter(
                               "\"shape\":{\"type\":\"mesh\",\"file\":\"absent.glb\"}"))
                  .find("key \"emitters[0].shape.file\": no such file"),
              std::string::npos);
    EXPECT_NE(parseMessage(R"({"version":1,"medium":"m","emitters":[],"capacity":1099511627776})")
                  .find("key \"capacity\": is 1099511627776, must be an integer from 1 to 67108864"),
              std::string::npos);
}

TEST(Effect_SubEmitters, Files_AreFollowedAndCyclesNamed) {
    const test::TempFolder folder;
    const auto write = [&](const char* name, const std::string& subEmitters) {
        folder.write(name, "{\"version\":1,\"medium\":\"" + std::string(name) +
                               "\",\"emitters\":[{\"lifetime\":1}],\n\"subEmitters\":[" +
                               subEmitters + "]}");
    };
    write("a.json", R"({"on":"death","effect":"b.json","count":[1,2.5]})");
    write("b.json", R"({"on":"way","effect":"c.json","rate":9})");
    write("c.json", "");
    const Effect effect = loadEffect(folder / "a.json", Log());
    ASSERT_EQ(effect.subEmitters.size(), 1u);
    EXPECT_EQ(effect.subEmitters[0].count, dvec2(1, 2.5));
    const Effect& below = *effect.subEmitters[0].effect;
    EXPECT_EQ(below.medium, "b.json");
    EXPECT_EQ(below.subEmitters[0].trigger, SubEmitterTrigger::Way);
    EXPECT_EQ(below.subEmitters[0].rate, 9);

    write("c.json", R"({"on":"birth","effect":"a.json"})");
    const std::string message = messageOf([&] { loadEffect(folder / "a.json", Log()); });
    EXPECT_NE(message.find("c.json:2:39: key \"subEmitters[0].effect\": leads back to an effect"),
              std::string::npos)
        << message;
    write("c.json", R"({"on":"way","effect":"b.json","rate":1,"count":3})");
    EXPECT_NE(messageOf([&] { loadEffect(folder / "c.json", Log()); })
                  .find("key \"subEmitters[0].count\": unknown key, known are effect, on, rate"),
              std::string::npos);
}

TEST(Effect_Defaults, ShortestFile_HasThem) {
    const Effect effect = parse(R"({"version":1,"medium":"m","emitters":[{"lifetime":3}]})");
    EXPECT_EQ(effect.capacity, 10000u);
    EXPECT_EQ(effect.tickRate, 120);
    EXPECT_FALSE(effect.smoothProfile);
    EXPECT_EQ(effect.shadowing, Shadowing::Particle);
    EXPECT_EQ(effect.emitters[0].lifetime, dvec2(3));
    EXPECT_EQ(effect.emitters[0].duration, kInfinity);
    EXPECT_EQ(effect.radius.keys.size(), 1u);
}

TEST(Effect_Errors, EachFault_IsNamedAtItsPlace) {
    const std::string start = "loading effect: e.json:1:";
    EXPECT_EQ(parseMessage("{\"version\":1}"),
              start + "1: key \"emitters\": missing, must be an array of 0 to 1024, each an object");
    EXPECT_EQ(parseMessage(withEmitter("\"speed\":[2,1]")),
              start + "61: key \"emitters[0].speed\": is [high, low], must be [low, high]");
    EXPECT_EQ(
        parseMessage(withEmitter("\"speed\":\"fast\"")),
        start +
            "61: key \"emitters[0].speed\": is \"fast\", must be a number of at least 0, or an "
            "array of 2, each a number of at least 0");
    EXPECT_EQ(
        parseMessage(withEmitter("\"direction\":[0,0,0]")),
        start +
            "65: key \"emitters[0].direction\": is zero, must be a direction of any length but "
            "zero");
    EXPECT_EQ(
        parseMessage(withEmitter("\"shape\":{\"type\":\"sphere\"}")),
        start + "61: key \"emitters[0].shape.radius\": missing, must be a number of at least 0");
    EXPECT_EQ(parseMessage(withEmitter("\"shape\":{\"type\":\"torus\"}")),
              start +
                  "69: key \"emitters[0].shape.type\": is \"torus\", must be one of \"point\", "
                  "\"line\", \"disc\", \"ring\", \"sphere\", \"box\", \"cone\", \"mesh\", \"volume\"");
    EXPECT_EQ(parseMessage(withEmitter("\"colour\":1")),
              start +
                  "53: key \"emitters[0].colour\": unknown key, known are bursts, delay, "
                  "direction, duration, inherit, lifetime, path, rate, shape, speed, spread, "
                  "velocity, velocityField");
    EXPECT_EQ(
        parseMessage(R"({"version":1,"medium":"m","emitters":[{"lifetime":0}]})"),
        start +
            "51: key \"emitters[0].lifetime\": is 0, must be a number above 0, or an array of "
            "2, each a number above 0");
}

TEST(Effect_Curves, UnsortedEmptyOrOutside_AreErrors) {
    const auto message = [](const std::string& curve) {
        return parseMessage(
            "{\"version\":1,\"medium\":\"m\",\"emitters\":[],\n\"overLife\":{\"radius\":" + curve +
            "}}");
    };
    const std::string start = "loading effect: e.json:2:";
    EXPECT_EQ(message("[]"),
              start +
                  "22: key \"overLife.radius\": is an array of 0, must be an array of "
                  "1 to 64, each an array [a number from 0 to 1, a number of at "
                  "least 0]");
    EXPECT_EQ(
        message("[[0.5,1],[0.5,2]]"),
        start +
            "32: key \"overLife.radius[1][0]\": is not above the age before it, ages must rise");
    EXPECT_EQ(message("[[1.5,1]]"),
              start + "24: key \"overLife.radius[0][0]\": is 1.5, must be a number from 0 to 1");
    EXPECT_EQ(message("[[0,1],[1,-1]]"),
              start + "32: key \"overLife.radius[1][1]\": is -1, must be a number of at least 0");
}

TEST(Effect_Ranges, JustOutside_IsRefused) {
    for (const char* keys : {"\"rate\":-1", "\"bursts\":[{\"time\":-1,\"count\":1}]",
                             "\"bursts\":[{\"time\":0,\"count\":1.5}]", "\"duration\":0",
                             "\"spread\":181", "\"shape\":{\"type\":\"box\",\"size\":[1,-1,1]}",
                             "\"speed\":-1", "\"bursts\":[{\"time\":0}]", "\"shape\":7"})
        EXPECT_NE(parseMessage(withEmitter(keys)), "no error") << keys;
    for (const char* keys :
         {"\"capacity\":0", "\"capacity\":67108865", "\"tickRate\":0.5", "\"tickRate\":10001",
          "\"profile\":\"soft\"", "\"modules\":[{}]", "\"modules\":[{\"type\":\"a\",\"x\":{}}]"})
        EXPECT_NE(parseMessage("{\"version\":1,\"medium\":\"m\",\"emitters\":[]," +
                               std::string(keys) + "}"),
                  "no error")
            << keys;
}

}  // namespace
}  // namespace brume::scene
