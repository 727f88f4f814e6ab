// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <shaders/particles/appearance.h>
#include <core/error.hpp>
#include <particles/appearance_curves.hpp>
#include <particles/blackbody.hpp>
#include <particles/cpu_simulation.hpp>

#include "effects.hpp"

namespace brume::particles {
namespace {

void expectRefused(const scene::Effect& effect, const std::string& part) {
    try {
        compileEffect(effect);
        FAIL() << "no error; expected: " << part;
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Input);
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

template <typename Change>
scene::Effect changed(Change&& change) {
    scene::Effect effect = busyEffect();
    change(effect);
    return effect;
}

TEST(Effect, ImpossibleValues_AreRefused) {
    expectRefused(changed([](auto& e) { e.capacity = 0; }), "'capacity' is 0");
    expectRefused(changed([](auto& e) { e.capacity = 1u << 31u; }), "'capacity' is 2147483648");
    expectRefused(changed([](auto& e) { e.tickRate = 0; }), "'tickRate' is 0");
    expectRefused(changed([](auto& e) { e.tickRate = std::nan(""); }), "'tickRate' is nan");
    expectRefused(changed([](auto& e) { e.emitters[1].rate = -1; }), "emitter 1: 'rate' is -1");
    expectRefused(changed([](auto& e) { e.emitters[0].lifetime = {-1, 1}; }), "'lifetime' is -1");
    expectRefused(changed([](auto& e) { e.emitters[0].speed = {2, 1}; }), "'speed' runs from 2");
    expectRefused(changed([](auto& e) { e.emitters[0].direction = dvec3(0); }),
                  "'direction' is zero");
    expectRefused(changed([](auto& e) { e.emitters[1].bursts[0].time = -1; }), "'time' of a burst");
    expectRefused(changed([](auto& e) { e.radius.keys.clear(); }),
                  "radius over life: the curve has");
    expectRefused(changed([](auto& e) { e.density.keys = {{0.5, 1}, {0.2, 0}}; }), "not sorted");
    expectRefused(changed([](auto& e) {
                      e.tint.keys = {{-0.5, dvec3(1)}};
                  }),
                  "the age of a key is");
    expectRefused(changed([](auto& e) {
                      e.radius.keys.clear();
                      for (int i = 0; i < 100; ++i) e.radius.keys.push_back({i / 100.0, 1});
                  }),
                  "keys at");
}

TEST(Appearance, Curves_ArePiecewiseLinear) {
    scene::Effect effect = burstEffect(1);
    effect.radius.keys = {{0.25, 1}, {0.5, 3}, {0.75, 2}};
    effect.density.keys = {{0, 1}, {0.4, 1}, {0.4, 5}, {1, 5}};
    effect.tint.keys = {{0, dvec3(1, 0, 0)}, {1, dvec3(0, 0, 1)}};
    const shader::EffectParameters parameters = compileEffect(effect)[0].parameters;
    const auto at = [&](float age) { return shader::evaluateAppearance(parameters, age, 0); };
    EXPECT_FLOAT_EQ(at(0).radius, 1);
    EXPECT_FLOAT_EQ(at(0.25f).radius, 1);
    EXPECT_FLOAT_EQ(at(0.375f).radius, 2);
    EXPECT_FLOAT_EQ(at(0.5f).radius, 3);
    EXPECT_FLOAT_EQ(at(1).radius, 2);
    EXPECT_FLOAT_EQ(at(0.39f).density, 1);
    EXPECT_NEAR(at(0.41f).density, 5, 1e-5);
    EXPECT_FLOAT_EQ(at(0.5f).tint.x, 0.5f);
    EXPECT_FLOAT_EQ(at(1).tint.z, 1);
}

TEST(Appearance, LargestTint_IsThatOfTheHottestMoment) {
    scene::Effect effect = burstEffect(1);
    effect.tint.keys = {{0, dvec3(0.5)}, {1, dvec3(2, 1, 1)}};
    EXPECT_FLOAT_EQ(largestTint(effect), 2);
    effect.temperature.keys = {{0, 1200}, {0.5, 2400}, {1, 1000}};
    const double hottest = 1.25 * blackbodyColor(2400).x;
    EXPECT_GT(hottest, 20);
    EXPECT_FLOAT_EQ(largestTint(effect), static_cast<float>(hottest));
}

TEST(Appearance, ConstantTint_IsWhatAllParticlesHave) {
    scene::Effect effect = burstEffect(1);
    EXPECT_EQ(constantTint(effect), vec3(1));
    effect.tint.keys = {{0, dvec3(0.5, 1, 2)}, {1, dvec3(0.5, 1, 2)}};
    EXPECT_EQ(constantTint(effect), vec3(0.5, 1, 2));
    effect.tint.keys[1].second.x = 0.6;
    EXPECT_EQ(constantTint(effect), std::nullopt);
    effect.tint.keys = {{0, dvec3(1)}};
    effect.temperature.keys = {{0, 1200}, {1, 1000}};
    EXPECT_EQ(constantTint(effect), std::nullopt) << "it cools";
}

TEST(CpuSimulation, DepthCollider_IsRefusedAtItsPlace) {
    scene::Effect effect = burstEffect(1);
    effect.modules = {moduleSettings("collide_depth")};
    try {
        CpuSimulation simulation(effect, 1);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()),
                  "simulating on the CPU: test.effect.json:3:5: module 'collide_depth' is not "
                  "replayable, it needs the picture of a device: allowed in 'render' and 'view' "
                  "with a method of the GPU");
    }
}

TEST(CpuSimulation, Spheres_FollowTransformAndAge) {
    scene::Effect effect = burstEffect(3, 2);
    effect.emitters[0].lifetime = dvec2(2);
    effect.radius.keys = {{0, 0}, {1, 1}};
    effect.smoothProfile = true;
    CpuSimulation simulation(effect, 1);
    simulation.advanceTo(1);
    dmat4 transform = glm::translate(dmat4(1), dvec3(1e6, 0, 0)) * glm::scale(dmat4(1), dvec3(3));
    const auto spheres = simulation.spheres(transform, 4, 100);
    ASSERT_EQ(spheres.size(), 3u);
    for (std::uint32_t i = 0; i < 3; ++i) {
        EXPECT_EQ(spheres[i].id, 100 + i);
        EXPECT_EQ(spheres[i].medium, 4u);
        EXPECT_EQ(spheres[i].profile, scene::Profile::Smooth);
        EXPECT_NEAR(spheres[i].center.x, 1e6, 1e-9);
        EXPECT_NEAR(spheres[i].center.y, 6, 1e-5);
        EXPECT_NEAR(spheres[i].radius, 1.5, 1e-6);
    }
}

TEST(CpuSimulation, SameSeed_GivesTheSameHash) {
    CpuSimulation a(busyEffect(), 5, 2), b(busyEffect(), 5, 2);
    a.step(300);
    b.step(300);
    EXPECT_GT(a.counters().alive, 500u);
    EXPECT_EQ(a.hash(), b.hash());
}

TEST(CpuSimulation, OtherSeedOrInstance_GivesOtherParticles) {
    CpuSimulation a(busyEffect(), 5, 2), b(busyEffect(), 6, 2), c(busyEffect(), 5, 3),
        d(busyEffect(), 5 + (1ull << 32u), 2);
    for (CpuSimulation* s : {&a, &b, &c, &d}) s->step(10);
    EXPECT_NE(a.hash(), b.hash());
    EXPECT_NE(a.hash(), c.hash());
    EXPECT_NE(a.hash(), d.hash());
}

}  // namespace
}  // namespace brume::particles
