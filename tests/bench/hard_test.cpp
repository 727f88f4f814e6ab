// SPDX-License-Identifier: Apache-2.0
// Every method on every hard case: right, or wrong as its info() says. And what is not used costs
// nothing.
#include <gpu/gpu_fixture.hpp>

#include <bench/hard_scenes.hpp>
#include <bench/measure.hpp>
#include <bench/suites/needs.hpp>
#include <bench/suites/suite.hpp>

namespace brume::bench {
namespace {

class HardTest : public test::GpuTest {
  protected:
    HardTest() { mKeepsPipelines = true; }  // of one scene for the next
    std::vector<Measurement> measure(NamedScene named, int size) {
        named.scene.image = {size, size, 1};
        MeasureOptions options;
        options.methods = listAllMethods();
        options.repeats = 1;
        options.warmups = 0;
        return measureScene(device(), named.name, prepareNamed(named, log()), options, log());
    }
};

using HardCases = HardTest;

TEST_F(HardCases, EveryMethod_IsRightOrHasSaidSo) {
    for (const HardCase& hard : listHardCases())
        for (const Measurement& m : measure(hard.make(), 16)) {
            ASSERT_TRUE(m.row.failure.empty()) << m.row.method << ": " << m.row.failure;
            EXPECT_NE(judgeHardCase(m.row.method, hard, *m.row.error), Verdict::Wrong)
                << m.row.method << ": max " << m.row.error->max << ", bias " << m.row.error->bias
                << ", " << m.row.error->nonFinite << " not finite; brume bench --scenes " << hard.name;
        }
}

using UnusedNeeds = HardTest;

TEST_F(UnusedNeeds, AddNoPassNoTargetAndNoBitOfTheImage) {
    const auto with = measure(makeScenes("need_unused").at(0), 24);
    const auto without = measure(makeScenes("need_unused_without").at(0), 24);
    ASSERT_EQ(with.size(), without.size());
    for (std::size_t i = 0; i < with.size(); ++i) {
        const Row &a = with[i].row, &b = without[i].row;
        ASSERT_TRUE(a.failure.empty() && b.failure.empty()) << a.failure << b.failure;
        ASSERT_EQ(a.passes.size(), b.passes.size()) << a.method;
        for (std::size_t p = 0; p < a.passes.size(); ++p)
            EXPECT_EQ(a.passes[p].name, b.passes[p].name);
        // Their lines in the tables of materials and media, and nothing else.
        EXPECT_LE(a.bytes.at("total"), b.bytes.at("total") + 1024) << a.method;
        EXPECT_EQ(a.imageHash, b.imageHash) << a.method;
    }
}

}  // namespace
}  // namespace brume::bench
