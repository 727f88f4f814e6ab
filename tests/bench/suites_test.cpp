// SPDX-License-Identifier: Apache-2.0
// Suites are data: every scene, method and setting that they name exists.
#include <gtest/gtest.h>

#include <bench/hard_scenes.hpp>
#include <bench/machine.hpp>
#include <bench/suites/needs.hpp>
#include <bench/suites/paper_table.hpp>
#include <oit/method_info.hpp>
#include <shadows/store_info.hpp>

#include <set>

namespace brume::bench {
namespace {

std::set<std::string> knownMethods() {
    std::set<std::string> names;
    for (const oit::MethodInfo& info : oit::listMethods()) names.emplace(info.name);
    for (const shadows::StoreInfo& info : shadows::listStores()) names.emplace(info.name);
    return names;
}

TEST(Suites, EveryPlan_NamesScenesAndMethodsThatExist) {
    const std::set<std::string> methods = knownMethods();
    for (const Suite& suite : listSuites())
        for (const Scale scale : {Scale::Quick, Scale::Full})
            for (const Plan& plan : suite.plan(scale)) {
                if (plan.kind == PlanKind::Simulation) continue;
                // The plume takes as long to make as it is large.
                if (plan.scene.find("1m") == std::string::npos) {
                    EXPECT_EQ(makeScenes(plan.scene).size(), 1u) << suite.name << " " << plan.scene;
                }
                EXPECT_FALSE(plan.methods.empty());
                for (const std::string& word : plan.methods)
                    EXPECT_TRUE(methods.contains(word.substr(0, word.find(':')))) << word;
            }
}

TEST(Suites, QuickOnes_CoverEveryMethodAndStore) {
    std::set<std::string> used;
    for (const Suite& suite : listSuites())
        for (const Plan& plan : suite.plan(Scale::Quick))
            for (const std::string& word : plan.methods) {
                used.insert(word.substr(0, word.find(':')));
                used.insert(plan.shadow);
                if (plan.scene.find("shadow") == std::string::npos) continue;
                for (const NamedScene& made : makeScenes(plan.scene))
                    for (const scene::Light& light : made.scene.lights) used.insert(light.shadow);
            }
    for (const std::string& name : knownMethods()) EXPECT_TRUE(used.contains(name)) << name;
}

TEST(Suites, PaperTable_SetsOursBesideThePublished) {
    Measurement m;
    m.row.scene = "s";
    m.row.method = "weighted";
    m.row.time.median = 10;
    m.row.passes = {{"shadow.bins", {1, 1, 1, 1}}, {"shadow.build", {2, 2, 2, 2}}, {"oit.x", {4, 4, 4, 4}}};
    const PaperTable paper{"t",
                           {{"Theirs", "s", "weighted",
                             {{"shadow", 6, "shadow."}, {"other", -1, "other"}, {"total", 20, "total"}},
                             2}},
                           {}};
    const Table table = makePaperTable(paper, std::vector<Measurement>{m});
    ASSERT_EQ(table.rows.size(), 3u);
    EXPECT_EQ(table.rows[0], (Cells{"Theirs", "s", "shadow", "6.00", "3.00", "0.5", "0.30", "0.30"}));
    EXPECT_EQ(table.rows[1][4], "7.00") << "what the named phases leave";
    EXPECT_EQ(table.rows[2][5], "0.5");
    EXPECT_EQ(makePaperTable(paper, {}).rows[0][4], "-") << "not measured";
}

TEST(Suites, Roof_IsTheLongerOfBytesAndFragments) {
    Machine machine;
    EXPECT_EQ(computeRoofMs(machine, 1000, 1000), 0);
    machine.bytesPerSecond = 1e6;
    machine.fragmentsPerSecond = 1e5;
    EXPECT_DOUBLE_EQ(computeRoofMs(machine, 1000, 10), 1);
    EXPECT_DOUBLE_EQ(computeRoofMs(machine, 1000, 1000), 10);
}

TEST(HardCases, Verdict_AllowsOnlyWhatTheMethodSays) {
    const HardCase order{"hard_order", "", {oit::Weakness::Order}, 1e-5, nullptr};
    const HardCase plain{"hard_thin", "", {}, 1e-5, nullptr};
    const ErrorMetrics off{.max = 0.1, .bias = 0.05}, noisy{.max = 0.1, .bias = 1e-4};
    const ErrorMetrics nan{.nonFinite = 1};
    EXPECT_EQ(judgeHardCase("weighted", order, off), Verdict::Said);
    EXPECT_EQ(judgeHardCase("weighted", plain, off), Verdict::Wrong);
    EXPECT_EQ(judgeHardCase("linked_list", order, off), Verdict::Wrong);
    EXPECT_EQ(judgeHardCase("tile:epsilon=0", order, {.max = 1e-4}), Verdict::Wrong);
    EXPECT_EQ(judgeHardCase("tile", order, {.max = 1e-4}), Verdict::Right) << "bounded";
    EXPECT_EQ(judgeHardCase("stochastic:samples=8", plain, noisy), Verdict::Said);
    EXPECT_EQ(judgeHardCase("stochastic", plain, off), Verdict::Wrong) << "biased";
    EXPECT_EQ(judgeHardCase("weighted", order, nan), Verdict::Wrong);
}

TEST(HardCases, OnlyApproximateMethods_HaveWeaknesses) {
    for (const oit::MethodInfo& info : oit::listMethods())
        EXPECT_EQ(info.weaknesses.empty(), info.exactness != oit::Exactness::Approximate) << info.name;
}

}  // namespace
}  // namespace brume::bench
