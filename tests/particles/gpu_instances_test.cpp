// SPDX-License-Identifier: Apache-2.0
// Many instances of one effect: what they cost, and that each is what it would be alone.
#include "effects.hpp"
#include "gpu_fixture.hpp"

#include <functional>

namespace brume::particles {
namespace {

class GpuInstancesTest : public GpuSimulationTest {
  protected:
    static std::vector<EffectInstance> makeInstances(std::uint32_t count) {
        std::vector<EffectInstance> instances;
        for (std::uint32_t i = 0; i < count; ++i) instances.push_back({i % 7, i});
        return instances;
    }

    std::uint64_t countDispatches(const std::function<void(gpu::Commands&)>& record) {
        std::uint64_t count = 0;
        sSubmitter->submitAndWait("count", [&](gpu::Commands& commands) {
            record(commands);
            count = commands.dispatchCount();
        });
        return count;
    }
};

scene::Effect smallEffect() {
    scene::Effect effect = busyEffect(40);
    effect.emitters.resize(2);
    return effect;
}

TEST_F(GpuInstancesTest, AThousand_TakeFourDispatchesPerTickAndSixPerSubEmitter) {
    scene::Effect effect = smallEffect();
    for (const std::uint64_t subEmitters : {0, 1}) {
        if (subEmitters > 0) effect.subEmitters = {fullEffect(40).subEmitters[1]};
        GpuSimulation gpu(device(), effect, makeInstances(1000));
        for (const std::uint64_t ticks : {1, 5})
            EXPECT_EQ(countDispatches([&](gpu::Commands& c) { gpu.recordTicks(c, ticks); }),
                      (4 + 6 * subEmitters) * ticks);
    }
}

TEST_F(GpuInstancesTest, AThousand_EachHaveTheBitsOfTheTwin) {
    const std::vector<EffectInstance> instances = makeInstances(1000);
    const scene::Effect effect = smallEffect();
    GpuSimulation gpu(device(), effect, instances);
    runTicks(gpu, 60);
    std::uint32_t alive = 0;
    for (std::uint32_t i = 0; i < 1000; i += 37) {
        CpuSimulation cpu(effect, instances[i].seed, instances[i].instance);
        cpu.step(60);
        alive += cpu.counters().alive;
        EXPECT_EQ(gpu.readState(*sSubmitter, i).hash(), cpu.hash()) << "instance " << i;
    }
    EXPECT_GT(alive, 500u);
}

TEST_F(GpuInstancesTest, Appearance_PlacesEachInstanceAtItsOwn) {
    const std::vector<EffectInstance> instances = makeInstances(5);
    const scene::Effect effect = smallEffect();
    GpuSimulation gpu(device(), effect, instances);
    std::vector<GpuSimulation::Appearance> places(5);
    std::uint64_t dispatches = 0;
    gpu::Buffer spheres(device(), {.name = "spheres", .bytes = 200 * sizeof(shader::SphereData)});
    sSubmitter->submitAndWait("appearance", [&](gpu::Commands& commands) {
        gpu.recordAdvanceTo(commands, 0.5);
        for (std::uint32_t i = 0; i < 5; ++i)
            places[i] = {.frame = glm::translate(dmat4(1), dvec3(100.0 * i, 0, 0)),
                         .medium = i,
                         .firstId = i << 24u,
                         .firstSphere = 40 * (4 - i)};
        dispatches = commands.dispatchCount();
        gpu.recordAppearance(commands, 0, {}, places, spheres);
        dispatches = commands.dispatchCount() - dispatches;
    });
    EXPECT_EQ(dispatches, 1u);
    const auto got = sSubmitter->readBuffer<shader::SphereData>(spheres, 200);
    for (std::uint32_t i = 0; i < 5; ++i) {
        CpuSimulation cpu(effect, instances[i].seed, instances[i].instance);
        cpu.advanceTo(0.5);
        const auto wanted = cpu.spheres(places[i].frame, i, i << 24u);
        ASSERT_GT(wanted.size(), 5u);
        for (std::size_t k = 0; k < wanted.size(); ++k) {
            const shader::SphereData& sphere = got[places[i].firstSphere + k];
            ASSERT_EQ(sphere.id, wanted[k].id);
            EXPECT_EQ(sphere.medium, i);
            EXPECT_LT(glm::length(dvec3(sphere.center) - wanted[k].center), 1e-4);
        }
    }
}

}  // namespace
}  // namespace brume::particles
