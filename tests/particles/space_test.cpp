// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <core/error.hpp>
#include <particles/cpu_simulation.hpp>

#include "effects.hpp"

#include <algorithm>

namespace brume::particles {
namespace {

scene::Effect inWorldSpace(scene::Effect effect) {
    effect.isWorldSpace = true;
    return effect;
}

/// Particles that stand still where they are born.
scene::Effect restingEffect() {
    scene::Effect effect;
    effect.emitters = {{.rate = 1000, .lifetime = dvec2(10)}};
    return inWorldSpace(effect);
}

scene::Placement movingAlong(const scene::Path& path, const dmat4& begin = dmat4(1)) {
    return {begin, path};
}

dvec3 worldPlace(const CpuSimulation& simulation, const Particle& particle) {
    return transformPoint(simulation.frame(dmat4(1)).worldFromParticles,
                          dvec3(particle.position));
}

/// When a particle was born, seconds.
double birthTime(const CpuSimulation& simulation, const Particle& particle) {
    return (particle.life.birthTick + 1.0 - double{particle.life.birthRemaining}) /
           simulation.effect().tickRate;
}

TEST(Space, StandingInstance_MovesAsInLocalSpace) {
    scene::Effect effect = fullEffect(500);
    for (scene::Emitter& emitter : effect.emitters) {
        emitter.path.clear();
        emitter.velocityField.reset();
    }
    CpuSimulation local(effect, 4), world(inWorldSpace(effect), 4);
    local.step(100);
    world.step(100);
    ASSERT_EQ(local.particles().size(), world.particles().size());
    for (std::size_t i = 0; i < local.particles().size(); ++i) {
        EXPECT_EQ(local.particles()[i].position, world.particles()[i].position);
        EXPECT_EQ(local.particles()[i].velocity, world.particles()[i].velocity);
    }
}

TEST(Space, MovingInstance_LeavesItsParticlesWhereTheyWereBorn) {
    const scene::Placement placement =
        movingAlong({{0, dvec3(0)}, {1, dvec3(90, 0, 0)}, {2, dvec3(90, 50, 0)}},
                    glm::translate(dmat4(1), dvec3(3, 4, 5)));
    CpuSimulation simulation(restingEffect(), 1, 0, placement);
    simulation.advanceTo(2);
    ASSERT_EQ(simulation.particles().size(), 2000u);
    for (const Particle& particle : simulation.particles()) {
        const dvec3 wanted(placement.at(birthTime(simulation, particle))[3]);
        // One tick at the corner of the path is straight between its ends.
        if (particle.life.birthTick == 120) continue;
        ASSERT_LT(glm::length(worldPlace(simulation, particle) - wanted), 2e-4)
            << particle.birthIndex;
    }
}

TEST(Space, LocalParticles_FollowTheInstance) {
    scene::Effect effect = restingEffect();
    effect.isWorldSpace = false;
    const scene::Placement placement = movingAlong({{0, dvec3(0)}, {1, dvec3(9, 0, 0)}});
    CpuSimulation simulation(effect, 1, 0, placement);
    simulation.advanceTo(1);
    for (const scene::MediumSphere& sphere :
         simulation.spheres(simulation.frame(placement.at(1)), 0, 0))
        EXPECT_LT(glm::length(sphere.center - dvec3(9, 0, 0)), 1e-6);
}

TEST(Space, Inherit_TakesOverTheInstancesVelocity) {
    scene::Effect effect = restingEffect();
    effect.emitters[0].inherit = 0.5;
    const dvec3 velocity(30, -4, 2);
    CpuSimulation simulation(effect, 1, 0, movingAlong({{0, dvec3(0)}, {10, 10.0 * velocity}}));
    simulation.advanceTo(1);
    for (const Particle& particle : simulation.particles())
        ASSERT_LT(glm::length(dvec3(particle.velocity) - 0.5 * velocity), 1e-3);
}

TEST(Space, TurnedAndScaledInstance_TurnsAndScalesItsBirthsButNotGravity) {
    scene::Effect effect = inWorldSpace(burstEffect(1, 2, {1, 0, 0}));
    effect.emitters[0].position = {1, 0, 0};
    effect.modules = {moduleSettings("gravity")};
    const dmat4 turned = glm::scale(
        glm::rotate(glm::translate(dmat4(1), dvec3(5, 6, 7)), kPi / 2, dvec3(0, 1, 0)), dvec3(3));
    CpuSimulation simulation(effect, 1, 0, {turned, {}});
    simulation.advanceTo(1);
    const dvec3 wanted = dvec3(5, 6, 7) + dvec3(0, 0, -3) + dvec3(0, -0.5 * 9.81, -6);
    EXPECT_LT(glm::length(worldPlace(simulation, simulation.particles()[0]) - wanted), 1e-4);
    const auto spheres = simulation.spheres(simulation.frame(turned), 0, 0);
    EXPECT_NEAR(spheres[0].radius, 3 * 0.05, 1e-6);
}

/// The instance's path does what the emitters' does: modules, noise and colliders stay where they
/// are, wherever the particles' origin goes.
TEST(Space, OriginThatMovesAlong_ChangesNoMotionInAnyModule) {
    const scene::Effect all = fullEffect(1000);
    const scene::Path path = {{0, dvec3(0)}, {2, dvec3(70, 0, -55)}};
    for (const scene::ModuleSettings& module : all.modules) {
        SCOPED_TRACE(module.type);
        // Most births are outside of the boxes that enclose.
        if (module.type.ends_with("_box") && module.texts.contains("side")) continue;
        scene::Effect effect = inWorldSpace(all);
        effect.subEmitters.clear();
        effect.modules = {module};
        effect.emitters.resize(4);
        scene::Effect emitters = effect;
        for (scene::Emitter& emitter : emitters.emitters) emitter.path = path;
        for (scene::Emitter& emitter : effect.emitters) emitter.path.clear();
        CpuSimulation still(emitters, 3), moving(effect, 3, 0, movingAlong(path));
        still.advanceTo(1);
        moving.advanceTo(1);
        EXPECT_GT(glm::length(dvec3(moving.frame(dmat4(1)).worldFromParticles[3])), 30);
        std::vector<double> errors;
        const std::size_t count = std::min(still.particles().size(), moving.particles().size());
        for (std::size_t i = 0; i < count; ++i)
            errors.push_back(glm::length(worldPlace(still, still.particles()[i]) -
                                         worldPlace(moving, moving.particles()[i])));
        std::sort(errors.begin(), errors.end());
        ASSERT_GT(count, 100u);
        EXPECT_EQ(still.particles().size(), moving.particles().size());
        EXPECT_LT(errors[errors.size() / 2], 1e-4);
        // Those that have hit an edge go other ways.
        EXPECT_LT(errors[errors.size() * 8 / 10], 1e-3);
    }
}

TEST(Space, AThousandKilometresAway_GivesTheSameBitsAlsoAfterARebase) {
    const scene::Effect effect = inWorldSpace(fullEffect(300));
    const scene::Path path = {{0, dvec3(1, 2, 3)}, {1, dvec3(70, 0, -55)}};
    const dvec3 far(1e6, -1e6, 1e6);
    const dmat4 turned = glm::rotate(dmat4(1), 0.7, dvec3(0, 1, 0));
    CpuSimulation here(effect, 2, 0, {turned, path});
    CpuSimulation there(effect, 2, 0, {glm::translate(dmat4(1), far) * turned, path});
    for (const double seconds : {0.4, 0.8, 1.2}) {
        here.advanceTo(seconds);
        there.advanceTo(seconds);
        EXPECT_EQ(here.hash(), there.hash());
        EXPECT_LT(glm::length(dvec3(there.frame(dmat4(1)).worldFromParticles[3]) - far -
                              dvec3(here.frame(dmat4(1)).worldFromParticles[3])),
                  1e-5 * 0.05);
    }
    there.rebase(far);
    EXPECT_LT(glm::length(dvec3(there.frame(dmat4(1)).worldFromParticles[3] -
                                here.frame(dmat4(1)).worldFromParticles[3])),
              1e-5 * 0.05);
    here.advanceTo(1.6);
    there.advanceTo(1.6);
    EXPECT_EQ(here.hash(), there.hash());
}

TEST(Space, AfterFortyEightHours_MotionIsThatOfTheStart) {
    // Without random numbers all births are alike.
    scene::Effect effect = restingEffect();
    effect.emitters[0].rate = 240;
    effect.emitters[0].speed = dvec2(2);
    effect.emitters[0].lifetime = dvec2(1);
    effect.modules = {moduleSettings("gravity"), moduleSettings("drag", {{"rate", {0.5}}})};
    constexpr double kHours = 48 * 3600.0;
    const scene::Path early = {{0, dvec3(0)}, {2, dvec3(60, 0, 0)}};
    const scene::Path late = {{kHours, dvec3(0)}, {kHours + 2, dvec3(60, 0, 0)}};
    CpuSimulation sooner(effect, 1, 0, movingAlong(early)), later(effect, 1, 0, movingAlong(late));
    sooner.advanceTo(2);
    later.advanceTo(kHours + 2);
    ASSERT_EQ(later.particles().size(), sooner.particles().size());
    // A rounding of a float.
    for (std::size_t i = 0; i < later.particles().size(); ++i)
        ASSERT_LT(glm::length(worldPlace(later, later.particles()[i]) -
                              worldPlace(sooner, sooner.particles()[i])),
                  2e-6);
}

TEST(InstanceSpace, MoveTo_InterpolatesAndKeepsTheOriginOfTheLastTick) {
    InstanceSpace space({dmat4(1), {}}, 100);
    EXPECT_FALSE(space.moveTo(glm::translate(dmat4(1), dvec3(40, 0, 0)), 10, 20));
    shader::BirthBatch batch{};
    space.place(batch, 14);
    EXPECT_FLOAT_EQ(batch.motion.x, 4);
    EXPECT_EQ(space.shiftAt(14), dvec3(16, 0, 0));
    EXPECT_FLOAT_EQ(batch.offset.x, 20 - 16);
    const dmat4 last = space.frameAt(20).worldFromParticles;
    EXPECT_TRUE(space.moveTo(glm::rotate(dmat4(1), 1.0, dvec3(0, 1, 0)), 20, 21));
    EXPECT_EQ(space.frameAt(20).worldFromParticles, last);
    EXPECT_EQ(space.shiftAt(19) + space.rebaseAt(20), space.shiftAt(20));
    EXPECT_EQ(space.frameAt(22).worldFromParticles, dmat4(1));
}

TEST(Space, WorldBelowLocal_IsRefused) {
    scene::Effect effect = fullEffect(100);
    scene::Effect child = *effect.subEmitters[0].effect;
    child.isWorldSpace = true;
    effect.subEmitters[0].effect = std::make_shared<const scene::Effect>(child);
    EXPECT_THROW(compileEffect(effect), Error);
}

}  // namespace
}  // namespace brume::particles
