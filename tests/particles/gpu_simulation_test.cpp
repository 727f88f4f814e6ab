// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include "effects.hpp"
#include "gpu_fixture.hpp"

namespace brume::particles {
namespace {

TEST_F(GpuSimulationTest, FirstTicks_GiveTheBitsOfTheTwin) {
    GpuSimulation gpu(device(), busyEffect(), 17, 3);
    CpuSimulation cpu(busyEffect(), 17, 3);
    expectSame(gpu, cpu);
    for (int i = 0; i < 5; ++i) {
        runTicks(gpu, 1);
        cpu.step(1);
        expectSame(gpu, cpu);
    }
}

TEST_F(GpuSimulationTest, ThousandTicksOfAllModules_GiveTheBitsOfTheTwin) {
    GpuSimulation gpu(device(), busyEffect(), 1);
    CpuSimulation cpu(busyEffect(), 1);
    for (const int ticks : {1, 9, 90, 400, 500}) {
        runTicks(gpu, static_cast<std::uint64_t>(ticks));
        cpu.step(static_cast<std::uint64_t>(ticks));
        expectSame(gpu, cpu);
    }
    EXPECT_GT(cpu.counters().died, 5000u);
}

TEST_F(GpuSimulationTest, Instances_EachHaveTheirOwnBitsInSharedDispatches) {
    const std::vector<EffectInstance> instances = {{3, 0}, {3, 1}, {99, 0}, {4, 7}};
    scene::Effect effect = busyEffect(300);
    effect.subEmitters = {fullEffect(300).subEmitters[1]};
    GpuSimulation gpu(device(), effect, instances, {16, 7});
    runTicks(gpu, 60);
    for (std::uint32_t i = 0; i < instances.size(); ++i) {
        CpuSimulation cpu(effect, instances[i].seed, instances[i].instance);
        cpu.step(60);
        EXPECT_GT(cpu.counters(1).born, 20u);
        EXPECT_EQ(gpu.readState(*sSubmitter, i).hash(), cpu.hash()) << i;
    }
}

TEST_F(GpuSimulationTest, RestoredState_GoesOnAsIfNothingHappened) {
    scene::Effect effect = busyEffect(400);
    effect.subEmitters = fullEffect(400).subEmitters;
    CpuSimulation cpu(effect, 2);
    cpu.step(90);
    GpuSimulation gpu(device(), effect, 2);
    gpu.writeState(*sSubmitter, std::array{cpu.state()});
    expectSame(gpu, cpu);
    runTicks(gpu, 50);
    CpuSimulation other(effect, 2);
    other.restore(cpu.state());
    other.step(50);
    cpu.step(50);
    expectSame(gpu, cpu);
    EXPECT_EQ(other.hash(), cpu.hash());
}

TEST_F(GpuSimulationTest, StiffDrag_GivesTheBitsOfTheTwin) {
    scene::Effect effect = busyEffect();
    effect.modules[1].values["rate"] = {3000};
    effect.modules[1].values["wind"] = {0, 0, 0};
    effect.modules[0].values["acceleration"] = {0, 0, 0};
    effect.modules.resize(2);
    GpuSimulation gpu(device(), effect, 1);
    CpuSimulation cpu(effect, 1);
    runTicks(gpu, 200);
    cpu.step(200);
    expectSame(gpu, cpu);
}

TEST_F(GpuSimulationTest, HugeForces_GiveTheBitsOfTheTwin) {
    scene::Effect effect = busyEffect();
    effect.tickRate = 1;
    effect.emitters[0].lifetime = {1e5, 1e6};
    effect.modules[0].values["acceleration"] = {1e12, -1e12, 1e12};
    effect.modules.insert(effect.modules.end(), 10, effect.modules[0]);
    effect.modules.erase(effect.modules.begin() + 1);  // no drag
    effect.capacity = 300;
    GpuSimulation gpu(device(), effect, 1);
    CpuSimulation cpu(effect, 1);
    for (int i = 0; i < 6; ++i) {
        runTicks(gpu, 100);
        cpu.step(100);
        expectSame(gpu, cpu);
    }
    EXPECT_GE(cpu.counters().died, 300u);
}

TEST_F(GpuSimulationTest, ManyChunks_AreScannedOverSeveralGroups) {
    scene::Effect effect = burstEffect(100000, 1);
    effect.emitters[0].lifetime = {0, 0.5};
    effect.emitters[0].bursts.push_back({0.1, 30000});
    GpuSimulation gpu(device(), effect, 2, 0, {64, 16});
    CpuSimulation cpu(effect, 2);
    runTicks(gpu, 30);
    cpu.step(30);
    expectSame(gpu, cpu);
}

TEST_F(GpuSimulationTest, ManyBatches_AreUploadedInSeveralParts) {
    scene::Effect effect = busyEffect(3000);
    for (int i = 0; i < 500; ++i)
        effect.emitters[3].bursts.push_back({0.1 + i * 1e-5, static_cast<std::uint32_t>(i % 4)});
    for (int i = 0; i < 30; ++i) effect.emitters.push_back(effect.emitters[0]);
    GpuSimulation gpu(device(), effect, 2);
    CpuSimulation cpu(effect, 2);
    runTicks(gpu, 150);
    cpu.step(150);
    expectSame(gpu, cpu);
}

TEST_F(GpuSimulationTest, AdvanceToThePast_StartsAnew) {
    GpuSimulation gpu(device(), busyEffect(), 2);
    CpuSimulation cpu(busyEffect(), 2);
    sSubmitter->submitAndWait("advance", [&](gpu::Commands& commands) {
        gpu.recordAdvanceTo(commands, 0.7);
        gpu.recordAdvanceTo(commands, 0.2);
    });
    cpu.advanceTo(0.2);
    expectSame(gpu, cpu);
}

TEST_F(GpuSimulationTest, LongFrames_StopAtTheirTicksAndCatchUp) {
    scene::Effect effect = burstEffect(1, 1);
    effect.capacity = 1000;
    effect.emitters = {{.rate = 500, .speed = {1, 2}, .spread = 1, .lifetime = {0.1, 0.5}}};
    CpuSimulation cpu(effect, 2);
    GpuSimulation gpu(device(), effect, 2);
    std::vector<std::uint64_t> behind;
    const auto advance = [&](double seconds) {
        sSubmitter->submitAndWait("advance", [&](gpu::Commands& commands) {
            behind.push_back(gpu.recordAdvanceTo(commands, seconds, 50));
        });
    };
    for (int i = 0; i < 3; ++i) advance(0.99);  // 118 ticks, no jump yet
    EXPECT_EQ(behind, (std::vector<std::uint64_t>{68, 18, 0}));
    cpu.advanceTo(0.99);
    expectSame(gpu, cpu);
    // An hour later only the last lifetime is run, in two calls.
    behind.clear();
    for (int i = 0; i < 2; ++i) advance(3600);
    const std::uint64_t window = gpu.effect().aliveBound.windowTicks();
    EXPECT_EQ(behind, (std::vector<std::uint64_t>{window - 50, 0}));
    cpu.advanceTo(3600);
    expectSame(gpu, cpu);
}

TEST_F(GpuSimulationTest, Appearance_MatchesTheTwinInCameraSpace) {
    scene::Effect effect = busyEffect();
    effect.smoothProfile = true;
    GpuSimulation gpu(device(), effect, 2);
    CpuSimulation cpu(effect, 2);
    cpu.advanceTo(1.5);
    const dvec3 camera(2e6, 10, -7);
    const dmat4 transform = glm::translate(dmat4(1), camera + dvec3(1, 2, 3)) *
                            glm::rotate(dmat4(1), 0.5, dvec3(1, 1, 0)) *
                            glm::scale(dmat4(1), dvec3(2));
    const auto expected = cpu.spheres(transform, 7, 1000);

    gpu::Buffer spheres;
    std::uint32_t slots = 0;
    sSubmitter->submitAndWait("appearance", [&](gpu::Commands& commands) {
        gpu.recordAdvanceTo(commands, 1.5);
        slots = gpu.slotCount();
        spheres = gpu::Buffer(
            device(), {.name = "spheres", .bytes = (slots + 4) * sizeof(shader::SphereData)});
        commands.fillBuffer(spheres, 0x7fc00000u);
        commands.computeTransferBarrier();
        const std::array appearances = {GpuSimulation::Appearance{
            .frame = transform, .medium = 7, .firstId = 1000, .firstSphere = 3}};
        gpu.recordAppearance(commands, 0, {camera}, appearances, spheres);
    });
    const auto got = sSubmitter->readBuffer<shader::SphereData>(spheres, slots + 1,
                                                                3 * sizeof(shader::SphereData));
    ASSERT_LE(expected.size(), slots);
    for (std::size_t i = 0; i < expected.size(); ++i) {
        ASSERT_EQ(got[i].id, expected[i].id);
        EXPECT_EQ(got[i].medium, 7u);
        EXPECT_EQ(got[i].profile, shader::kProfileSmooth);
        ASSERT_LT(glm::length(dvec3(got[i].center) + camera - expected[i].center), 2e-5);
        ASSERT_NEAR(got[i].radius, expected[i].radius, 1e-6);
        ASSERT_NEAR(got[i].density, expected[i].density, 1e-6);
        ASSERT_LT(glm::length(got[i].tint - expected[i].tint), 1e-6);
    }
    for (std::size_t i = expected.size(); i < slots; ++i) ASSERT_EQ(got[i].radius, 0.0f);
    EXPECT_TRUE(std::isnan(got[slots].radius)) << "wrote beyond its slots";
}

TEST_F(GpuSimulationTest, SlotCount_FollowsTheLongestLifetime) {
    scene::Effect effect = burstEffect(1);
    effect.capacity = 100000;
    effect.emitters[0].rate = 1200;
    effect.emitters[0].lifetime = {0.1, 0.5};
    GpuSimulation gpu(device(), effect, 2);
    CpuSimulation cpu(effect, 2);
    runTicks(gpu, 300);
    cpu.step(300);
    expectSame(gpu, cpu);
    EXPECT_LE(gpu.slotCount(), 650u);
}

}  // namespace
}  // namespace brume::particles
