// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <particles/budget.hpp>
#include <particles/cpu_simulation.hpp>

#include "effects.hpp"

namespace brume::particles {
namespace {

/// Instances of two effects in turn; the second has a sub-emitter.
scene::Scene makeScene(std::uint32_t budgetOfFirst = 0) {
    scene::Effect first = burstEffect(100), second = burstEffect(50);
    first.budget = budgetOfFirst;
    scene::Effect child = burstEffect(1);
    child.capacity = 30;
    child.emitters[0].bursts.clear();
    second.subEmitters = {{.trigger = scene::SubEmitterTrigger::Birth,
                           .effect = std::make_shared<const scene::Effect>(child)}};
    scene::Scene scene;
    for (int i = 0; i < 2; ++i) {
        scene.effects.push_back({.file = "/first.json", .effect = first});
        scene.effects.push_back({.file = "/second.json", .effect = second});
        scene.effects.push_back({.file = "/second.json", .effect = child, .isSubEmitter = true});
    }
    return scene;
}

std::vector<std::uint32_t> capacitiesOf(const scene::Scene& scene) {
    std::vector<std::uint32_t> capacities;
    for (const scene::EffectInstance& effect : scene.effects)
        capacities.push_back(effect.effect.capacity);
    return capacities;
}

TEST(Budget, OfTheScene_KeepsTheFirstInOrder) {
    scene::Scene scene = makeScene();
    EXPECT_EQ(applyBudgets(scene).entries, 0u);
    scene.particleBudget = 210;
    const BudgetCut cut = applyBudgets(scene);
    EXPECT_EQ(capacitiesOf(scene), (std::vector<std::uint32_t>{100, 50, 30, 30, 0, 0}));
    EXPECT_EQ(cut.wanted, 360u);
    EXPECT_EQ(cut.granted, 210u);
    EXPECT_EQ(cut.entries, 3u);
    EXPECT_EQ(cut.first, 3u);
    EXPECT_EQ(scene.effects[4].effect.subEmitters[0].effect->capacity, 0u);
    applyBudgets(scene);
    EXPECT_EQ(capacitiesOf(scene), (std::vector<std::uint32_t>{100, 50, 30, 30, 0, 0}));
}

TEST(Budget, OfEffectsThatAreGone_GoesBackToThoseThatWereCut) {
    scene::Scene scene = makeScene();
    scene.particleBudget = 210;
    applyBudgets(scene);
    scene.effects.erase(scene.effects.begin());
    const BudgetCut cut = applyBudgets(scene);
    EXPECT_EQ(capacitiesOf(scene), (std::vector<std::uint32_t>{50, 30, 100, 30, 0}));
    EXPECT_EQ(cut.changed, (std::vector<std::size_t>{2, 3}));
    scene.effects.erase(scene.effects.begin(), scene.effects.begin() + 2);
    EXPECT_EQ(applyBudgets(scene).entries, 0u);
    EXPECT_EQ(capacitiesOf(scene), (std::vector<std::uint32_t>{100, 50, 30}));
    EXPECT_EQ(scene.effects[1].effect.subEmitters[0].effect->capacity, 30u);
    EXPECT_TRUE(applyBudgets(scene).changed.empty());
}

TEST(Budget, OfAnEffect_CountsItsInstancesAlone) {
    scene::Scene scene = makeScene(140);
    applyBudgets(scene);
    EXPECT_EQ(capacitiesOf(scene), (std::vector<std::uint32_t>{100, 50, 30, 40, 50, 30}));
}

TEST(Budget, Cut_IsWarnedOfInOneLine) {
    scene::Scene scene = makeScene();
    scene.particleBudget = 210;
    std::vector<std::string> lines;
    const Log log([&](LogLevel, const std::string& text) { lines.push_back(text); });
    warnOfCut(applyBudgets(scene), scene, log);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].find("210 of 360 particles"), std::string::npos) << lines[0];
    EXPECT_NE(lines[0].find("first.json"), std::string::npos) << lines[0];
    EXPECT_EQ(lines[0].find('\n'), std::string::npos);
}

TEST(Budget, CutEffects_KeepTheirFirstParticlesAndCountTheRest) {
    scene::Scene scene = makeScene();
    scene.particleBudget = 210;
    applyBudgets(scene);
    CpuSimulation whole(makeScene().effects[3].effect, 1), cut(scene.effects[3].effect, 1);
    whole.step(20);
    cut.step(20);
    EXPECT_EQ(cut.counters().alive, 30u);
    EXPECT_EQ(cut.counters().rejected, 70u);
    for (std::size_t i = 0; i < 30; ++i)
        EXPECT_EQ(cut.particles()[i].position, whole.particles()[i].position);
    CpuSimulation none(scene.effects[4].effect, 1);
    none.step(20);
    EXPECT_EQ(none.counters().alive, 0u);
    EXPECT_EQ(none.counters().rejected, 50u);
    EXPECT_EQ(none.counters(1).alive, 0u);
}

}  // namespace
}  // namespace brume::particles
