// SPDX-License-Identifier: Apache-2.0
#include "effects.hpp"
#include "gpu_fixture.hpp"

namespace brume::particles {
namespace {

using GpuSpaceTest = GpuSimulationTest;

std::vector<EffectInstance> movingInstances(const dvec3& begin) {
    const dmat4 place = glm::translate(dmat4(1), begin);
    const dmat4 turned = place * glm::rotate(dmat4(1), 0.8, dvec3(1, 2, 0));
    const dmat4 scaled = place * glm::scale(dmat4(1), dvec3(1.5));
    return {{3, 0, {place, {}}},
            {3, 1, {turned, {{0.1, dvec3(1, 0, 3)}, {0.9, dvec3(-70, 20, 3)}}}},
            {9, 7, {scaled, {{0, dvec3(0)}, {0.3, dvec3(0, 0, 300)}}}}};
}

scene::Effect worldEffect() {
    const scene::Effect all = fullEffect(250);
    scene::Effect effect = all;
    effect.isWorldSpace = true;
    // Each way that a place goes into a module, and one sub-emitter: more takes long to compile.
    std::erase_if(effect.modules, [](const scene::ModuleSettings& module) {
        return module.type != "gravity" && module.type != "curl_noise" &&
               module.type != "attractor" && module.type != "collide_plane" &&
               module.type != "velocity_field";
    });
    effect.subEmitters = {all.subEmitters[3]};
    return effect;
}

TEST_F(GpuSpaceTest, MovingInstances_HaveTheBitsOfTheTwin) {
    const std::vector<EffectInstance> instances = movingInstances(dvec3(5, -3, 2));
    GpuSimulation gpu(device(), worldEffect(), instances);
    runTicks(gpu, 1);
    runTicks(gpu, 119);
    for (std::uint32_t i = 0; i < instances.size(); ++i) {
        const EffectInstance& one = instances[i];
        CpuSimulation cpu(worldEffect(), one.seed, one.instance, one.placement);
        cpu.step(120);
        EXPECT_GT(cpu.counters(1).born, 20u);
        const SimulationState state = gpu.readState(*sSubmitter, i);
        for (std::uint32_t p = 0; p < cpu.populationCount(); ++p) {
            SCOPED_TRACE(testing::Message() << "instance " << i << ", population " << p);
            expectSame(state.populations[p], cpu.particles(p));
        }
        EXPECT_EQ(gpu.frame(i, dmat4(1)).worldFromParticles,
                  cpu.frame(dmat4(1)).worldFromParticles);
    }
}

TEST_F(GpuSpaceTest, AThousandKilometresAway_HaveTheSameBitsAlsoAfterARebase) {
    const dvec3 far(1e6, -1e6, 1e6);
    GpuSimulation here(device(), worldEffect(), movingInstances(dvec3(0)));
    GpuSimulation there(device(), worldEffect(), movingInstances(far));
    for (int part = 0; part < 2; ++part) {
        runTicks(here, 60);
        runTicks(there, 60);
        for (std::uint32_t i = 0; i < 3; ++i) {
            EXPECT_EQ(here.readState(*sSubmitter, i).hash(), there.readState(*sSubmitter, i).hash());
            const dvec3 a(here.frame(i, dmat4(1)).worldFromParticles[3]);
            const dvec3 b(there.frame(i, dmat4(1)).worldFromParticles[3]);
            EXPECT_LT(glm::length(b - (part == 0 ? far : dvec3(0)) - a), 1e-5 * 0.05);
        }
        there.rebase(far);
        if (part == 1) continue;
        for (std::uint32_t i = 0; i < 3; ++i)
            EXPECT_LT(glm::length(dvec3(there.frame(i, dmat4(1)).worldFromParticles[3] -
                                        here.frame(i, dmat4(1)).worldFromParticles[3])),
                      1e-5 * 0.05);
    }
}

TEST_F(GpuSpaceTest, MovingInstancesAfterFortyEightHours_HaveTheBitsOfTheTwin) {
    constexpr double kHours = 48 * 3600.0;
    scene::Effect effect = worldEffect();
    effect.subEmitters.clear();  // so that it jumps there
    effect.capacity = 9000;      // and never runs out
    const EffectInstance one{
        3,
        1,
        {dmat4(1), {{0, dvec3(0)}, {kHours, dvec3(2e5, 0, 0)}, {kHours + 9, dvec3(2e5, 90, 0)}}}};
    GpuSimulation gpu(device(), effect, std::array{one});
    CpuSimulation cpu(effect, one.seed, one.instance, one.placement);
    sSubmitter->submitAndWait(
        "jump", [&](gpu::Commands& commands) { gpu.recordAdvanceTo(commands, kHours + 1.5); });
    cpu.advanceTo(kHours + 1.5);
    EXPECT_GT(cpu.counters().alive, 100u);
    EXPECT_EQ(gpu.tick(), static_cast<std::uint64_t>((kHours + 1.5) * effect.tickRate));
    expectSame(gpu.readState(*sSubmitter).populations[0], cpu.particles());
    EXPECT_EQ(gpu.frame(0, dmat4(1)).worldFromParticles, cpu.frame(dmat4(1)).worldFromParticles);
    EXPECT_NEAR(gpu.frame(0, dmat4(1)).worldFromParticles[3].x, 2e5, 16);
}

TEST_F(GpuSpaceTest, HostsMoves_LeaveBirthsAlongTheWay) {
    scene::Effect effect;
    effect.isWorldSpace = true;
    effect.emitters = {{.rate = 1000, .lifetime = dvec2(10)}};
    GpuSimulation gpu(device(), effect, std::array{EffectInstance{1, 0}});
    sSubmitter->submitAndWait("move", [&](gpu::Commands& commands) {
        gpu.recordAdvanceTo(commands, 0.5);
        gpu.moveTo(0, glm::translate(dmat4(1), dvec3(100, 0, 0)), 1);
        gpu.recordAdvanceTo(commands, 1);
    });
    const SimulationState state = gpu.readState(*sSubmitter);
    const dmat4 world = gpu.frame(0, dmat4(1)).worldFromParticles;
    ASSERT_EQ(state.populations[0].size(), 1000u);
    for (const Particle& p : state.populations[0]) {
        const double time = (p.life.birthTick + 1.0 - double{p.life.birthRemaining}) / 120;
        const dvec3 wanted(200 * std::max(time - 0.5, 0.0), 0, 0);
        ASSERT_LT(glm::length(transformPoint(world, dvec3(p.position)) - wanted), 2e-4);
    }
}

}  // namespace
}  // namespace brume::particles
