// SPDX-License-Identifier: Apache-2.0
// Colliders: nothing passes, bounces and friction have their closed forms.
#include <gtest/gtest.h>
#include <particles/cpu_simulation.hpp>

#include "effects.hpp"

namespace brume::particles {
namespace {

scene::ModuleSettings withWord(scene::ModuleSettings settings, const std::string& key,
                               const std::string& value) {
    settings.texts[key] = value;
    return settings;
}

/// `count` particles that start in a ball around `center` in all directions at `speed`.
scene::Effect shotEffect(std::uint32_t count, const dvec3& center, double radius, double speed) {
    scene::Effect effect = burstEffect(count, speed);
    effect.emitters[0].shape = scene::EmitterShape::Sphere;
    effect.emitters[0].position = center;
    effect.emitters[0].radius = radius;
    effect.emitters[0].spread = kPi;
    return effect;
}

TEST(Colliders, HundredThousandAt500MetresPerSecond_NonePassesAThinWall) {
    // A wall of 1 mm all around: the way of a tick is 4 m.
    scene::Effect effect = burstEffect(100000, 500, {1, 0, 0});
    effect.emitters[0].spread = 0.5;
    effect.modules = {moduleSettings(
        "collide_box", {{"center", {5, 0, 0}}, {"size", {0.001, 1000, 1000}}, {"friction", {0}}})};
    CpuSimulation simulation(effect, 1);
    simulation.step(20);
    ASSERT_EQ(simulation.counters().alive, 100000u);
    std::size_t passed = 0, returned = 0;
    for (const Particle& p : simulation.particles()) {
        passed += p.position.x > 4.9996f;
        returned += p.velocity.x < 0;
    }
    EXPECT_EQ(passed, 0u);
    EXPECT_EQ(returned, 100000u);
}

TEST(Colliders, ClosedVolumes_KeepEverythingInside) {
    const auto inside = [](const char* type, std::vector<double> size) {
        return withWord(moduleSettings(type, {{"size", size}, {"restitution", {1}},
                                              {"friction", {0}}}),
                        "side", "inside");
    };
    for (const scene::ModuleSettings& module :
         {inside("collide_sphere", {1}), inside("collide_box", {1, 1, 1})}) {
        SCOPED_TRACE(module.type);
        scene::Effect effect = shotEffect(3000, dvec3(0), 0.4, 700);
        effect.modules = {module, moduleSettings("gravity")};
        CpuSimulation simulation(effect, 1);
        simulation.step(60);
        ASSERT_EQ(simulation.counters().alive, 3000u);
        const bool isBall = module.type == "collide_sphere";
        for (const Particle& p : simulation.particles()) {
            const dvec3 q = glm::abs(dvec3(p.position));
            ASSERT_LE(isBall ? glm::length(q) : 2 * std::max({q.x, q.y, q.z}), 1 + 1e-5);
        }
    }
}

TEST(Colliders, SolidShapes_AreNeverEntered) {
    const std::vector<std::pair<scene::ModuleSettings, double (*)(dvec3)>> solids = {
        {moduleSettings("collide_sphere", {{"size", {0.5}}}),
         [](dvec3 p) { return glm::length(p) - 0.5; }},
        {moduleSettings("collide_box", {{"size", {1, 0.6, 0.02}}}),
         [](dvec3 p) {
             const dvec3 d = glm::abs(p) - dvec3(0.5, 0.3, 0.01);
             return std::max({d.x, d.y, d.z});
         }},
        {moduleSettings("collide_capsule", {{"from", {-0.5, 0, 0}}, {"to", {0.5, 0, 0}},
                                            {"size", {0.05}}}),
         [](dvec3 p) {
             p.x -= std::clamp(p.x, -0.5, 0.5);
             return glm::length(p) - 0.05;
         }}};
    for (const auto& [module, distance] : solids) {
        SCOPED_TRACE(module.type);
        scene::Effect effect = shotEffect(3000, dvec3(0), 2.5, 300);
        effect.emitters[0].fromSurface = true;
        effect.modules = {module, withWord(moduleSettings("collide_sphere", {{"size", {3}},
                                                          {"restitution", {1}}}),
                                           "side", "inside")};
        CpuSimulation simulation(effect, 1);
        for (int i = 0; i < 40; ++i) {
            simulation.step(1);
            for (const Particle& p : simulation.particles())
                ASSERT_GT(distance(dvec3(p.position)), -1e-5) << i << " " << p.birthIndex;
        }
        EXPECT_EQ(simulation.counters().alive, 3000u);
    }
}

TEST(Colliders, Ball_BouncesToItsHeight) {
    scene::Effect effect = burstEffect(1);
    effect.emitters[0].position = {0, 1, 0};
    effect.tickRate = 1000;
    effect.modules = {moduleSettings("gravity"),
                      moduleSettings("collide_plane", {{"restitution", {0.8}}})};
    CpuSimulation simulation(effect, 1);
    const double fall = std::sqrt(2 / 9.81);
    simulation.advanceTo(fall + 0.8 * fall);  // at the top again
    EXPECT_NEAR(simulation.particles()[0].position.y, 0.64, 2e-3);
    EXPECT_NEAR(simulation.particles()[0].velocity.y, 0, 2e-2);
}

TEST(Colliders, RestingParticle_StaysAtRest) {
    scene::Effect effect = burstEffect(1);
    effect.emitters[0].position = {0, 0.5, 0};
    effect.modules = {moduleSettings("gravity"),
                      moduleSettings("collide_plane", {{"restitution", {0.5}}, {"radius", {0.1}}})};
    CpuSimulation simulation(effect, 1);
    simulation.advanceTo(20);
    EXPECT_NEAR(simulation.particles()[0].position.y, 0.1, 1e-6);
    EXPECT_EQ(simulation.particles()[0].velocity, vec3(0));
}

TEST(Colliders, SlidingParticle_StopsAfterCoulombsWay) {
    // v^2 / (2 mu g).
    scene::Effect effect = burstEffect(1, 3, {1, 0, 0});
    effect.tickRate = 1000;
    effect.modules = {moduleSettings("gravity"),
                      moduleSettings("collide_plane", {{"friction", {0.4}}})};
    CpuSimulation simulation(effect, 1);
    simulation.advanceTo(5);
    EXPECT_NEAR(simulation.particles()[0].position.x, 9 / (2 * 0.4 * 9.81), 5e-3);
    EXPECT_EQ(simulation.particles()[0].velocity.x, 0.0f);
}

TEST(Colliders, Stick_HoldsForEver) {
    scene::Effect effect = burstEffect(200, 10, {1, -1, 0});
    effect.emitters[0].position = {0, 0.1, 0};
    effect.emitters[0].spread = 0.3;
    effect.modules = {moduleSettings("gravity"),
                      moduleSettings("drag", {{"wind", {0, 30, 0}}, {"rate", {3}}}),
                      withWord(moduleSettings("collide_plane"), "response", "stick")};
    CpuSimulation simulation(effect, 1);
    simulation.advanceTo(0.3);
    const std::vector<Particle> before = simulation.particles();
    simulation.advanceTo(3);
    ASSERT_EQ(simulation.particles().size(), before.size());
    int stuck = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (before[i].position.y != 0) continue;
        ++stuck;
        ASSERT_EQ(simulation.particles()[i].position, before[i].position);
    }
    EXPECT_GT(stuck, 100);
}

TEST(Colliders, StuckParticles_StillDieOfAge) {
    scene::Effect effect = burstEffect(10, 10, {0, -1, 0});
    effect.emitters[0].position = {0, 0.1, 0};
    effect.emitters[0].lifetime = dvec2(0.5);
    effect.modules = {withWord(moduleSettings("collide_plane"), "response", "stick")};
    CpuSimulation simulation(effect, 1);
    simulation.advanceTo(0.45);
    EXPECT_EQ(simulation.counters().alive, 10u);
    simulation.advanceTo(0.55);
    EXPECT_EQ(simulation.counters().alive, 0u);
}

TEST(Killers, LeavingTheAllowedSide_Kills) {
    for (const scene::ModuleSettings& module :
         {moduleSettings("kill_plane", {{"point", {0, -1, 0}}}),
          withWord(moduleSettings("kill_sphere", {{"size", {2}}}), "side", "inside"),
          withWord(moduleSettings("kill_box", {{"size", {2, 2, 2}}}), "side", "inside"),
          moduleSettings("kill_sphere", {{"center", {0, -30, 0}}, {"size", {1}}}),
          moduleSettings("kill_box", {{"center", {0, -30, 0}}, {"size", {1, 1, 1}}})}) {
        SCOPED_TRACE(module.type);
        scene::Effect effect = burstEffect(50, 400, {0, -1, 0});
        effect.emitters[0].bursts.push_back({0, 50});
        effect.capacity = 100;
        effect.modules = {module};
        CpuSimulation simulation(effect, 1);
        simulation.step(20);
        EXPECT_EQ(simulation.counters().died, 100u);
        EXPECT_EQ(simulation.counters().killed, 0u);  // killed by a rule, not for being NaN
    }
}

}  // namespace
}  // namespace brume::particles
