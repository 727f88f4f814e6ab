// SPDX-License-Identifier: Apache-2.0
#include <particles/budget.hpp>
#include <particles/gpu_bounds.hpp>

#include "effects.hpp"
#include "gpu_fixture.hpp"

namespace brume::particles {
namespace {

using GpuBoundsTest = GpuSimulationTest;

TEST_F(GpuBoundsTest, Boxes_HoldEveryParticleAndLittleElse) {
    scene::Effect effect = busyEffect(700);
    effect.modules.resize(1);
    effect.thinning = {30, 0.1};
    std::vector<EffectInstance> instances;
    std::vector<GpuSimulation::Appearance> places;
    std::vector<SphereRange> ranges;
    const Viewer viewer{{1e5, 3, -40}};
    constexpr std::uint32_t kInstances = 7;
    for (std::uint32_t i = 0; i < kInstances; ++i) {
        instances.push_back({5, i});
        const dmat4 place = glm::rotate(
            glm::translate(dmat4(1), dvec3(1e5 + 20.0 * i, i, -2.0 * i)), 0.3 * i, dvec3(1, 0, 1));
        places.push_back({.frame = place, .firstId = i << 24u, .firstSphere = 700 * i});
    }
    GpuSimulation gpu(device(), effect, instances);
    gpu::Buffer spheres(device(), {.name = "spheres",
                                   .bytes = 700 * kInstances * sizeof(shader::SphereData)});
    GpuBounds bounds(device(), kInstances + 1);
    std::uint64_t dispatches = 0;
    sSubmitter->submitAndWait("bounds", [&](gpu::Commands& commands) {
        gpu.recordAdvanceTo(commands, 1.1);
        gpu.recordAppearance(commands, 0, viewer, places, spheres);
        for (std::uint32_t i = 0; i < kInstances; ++i) ranges.push_back({700 * i, gpu.slotCount()});
        ranges.push_back({0, 0});
        dispatches = commands.dispatchCount();
        bounds.record(commands, spheres, ranges);
        dispatches = commands.dispatchCount() - dispatches;
    });
    EXPECT_EQ(dispatches, 1u);
    const auto words = sSubmitter->readBuffer<std::uint32_t>(bounds.words(), 6 * (kInstances + 1));
    const std::vector<Box3> boxes = GpuBounds::makeBoxes(words, viewer.position);
    EXPECT_TRUE(boxes[kInstances].isEmpty());
    std::size_t thinned = 0;
    for (std::uint32_t i = 0; i < kInstances; ++i) {
        CpuSimulation cpu(effect, instances[i].seed, instances[i].instance);
        cpu.advanceTo(1.1);
        Box3 tight;
        const auto shown = cpu.spheres(places[i].frame, 0, 0, 0, viewer);
        thinned += cpu.particles().size() - shown.size();
        ASSERT_GT(shown.size(), 50u);
        for (const scene::MediumSphere& sphere : shown) {
            for (const double side : {-1.0, 1.0}) {
                const dvec3 corner = sphere.center + side * double{sphere.radius};
                // The twin rounds elsewhere: a millionth of the distance.
                ASSERT_TRUE(glm::all(glm::greaterThan(corner, boxes[i].lo - 2e-5)));
                ASSERT_TRUE(glm::all(glm::lessThan(corner, boxes[i].hi + 2e-5)));
                tight.extend(corner);
            }
        }
        EXPECT_LT(glm::length(boxes[i].lo - tight.lo), 2e-3);
        EXPECT_LT(glm::length(boxes[i].hi - tight.hi), 2e-3);
    }
    EXPECT_GT(thinned, 500u);

    // Against what the device itself has written there is nothing to forgive.
    const auto written = sSubmitter->readBuffer<shader::SphereData>(spheres, 700 * kInstances);
    for (std::uint32_t i = 0; i < kInstances; ++i)
        for (std::uint32_t k = 0; k < gpu.slotCount(); ++k) {
            const shader::SphereData& s = written[700 * i + k];
            if (!(s.radius > 0)) continue;
            const dvec3 center = viewer.position + dvec3(s.center) + dvec3(s.centerLo);
            ASSERT_TRUE(glm::all(glm::lessThanEqual(boxes[i].lo, center - double{s.radius})));
            ASSERT_TRUE(glm::all(glm::greaterThanEqual(boxes[i].hi, center + double{s.radius})));
        }
}

TEST_F(GpuBoundsTest, OrderedKeys_RiseWithTheirFloats) {
    float before = -3e38f;
    for (const float x : {-1e20f, -2.0f, -1e-30f, 0.0f, 1e-30f, 1.0f, 3e38f}) {
        EXPECT_LT(shader::orderedKey(before), shader::orderedKey(x));
        EXPECT_EQ(shader::fromOrderedKey(shader::orderedKey(x)), x);
        before = x;
    }
}

TEST_F(GpuBoundsTest, EffectsCutToNothing_HaveTheBitsOfTheTwin) {
    scene::Effect effect = busyEffect(40);
    effect.modules.resize(1);
    effect.subEmitters = {fullEffect(40).subEmitters[1]};
    scene::Scene scene;
    for (const std::uint64_t budget : {100ull, 1ull}) {
        scene.effects = {{.effect = effect},
                         {.effect = *effect.subEmitters[0].effect, .isSubEmitter = true},
                         {.effect = effect},
                         {.effect = *effect.subEmitters[0].effect, .isSubEmitter = true}};
        scene.particleBudget = budget;
        applyBudgets(scene);
        // The second instance keeps 20 of its 40 particles, then none.
        const scene::Effect& cut = scene.effects[2].effect;
        GpuSimulation gpu(device(), cut, 1);
        CpuSimulation cpu(cut, 1);
        runTicks(gpu, 40);
        cpu.step(40);
        expectSame(gpu, cpu);
        EXPECT_GT(cpu.counters().rejected, 0u);
        EXPECT_EQ(gpu.readCounters(*sSubmitter, 0).rejected, cpu.counters().rejected);
    }
}

}  // namespace
}  // namespace brume::particles
