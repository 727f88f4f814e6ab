// SPDX-License-Identifier: Apache-2.0
// Percentiles and summaries against values worked out by hand.
#include <gtest/gtest.h>

#include <bench/statistics.hpp>
#include <cmath>

namespace brume::bench {
namespace {

TEST(Percentile, OddCount_MedianIsTheMiddle) { EXPECT_EQ(percentile({5, 1, 3}, 0.5), 3); }

TEST(Percentile, EvenCount_MedianLiesBetween) { EXPECT_EQ(percentile({4, 1, 3, 2}, 0.5), 2.5); }

TEST(Percentile, Ends_AreSmallestAndLargest) {
    EXPECT_EQ(percentile({4, 1, 3, 2}, 0), 1);
    EXPECT_EQ(percentile({4, 1, 3, 2}, 1), 4);
}

TEST(Percentile, ZeroToHundred_RankIsTheValue) {
    std::vector<double> values;
    for (int i = 100; i >= 0; --i) values.push_back(i);
    for (double q : {0.05, 0.25, 0.95, 0.999}) EXPECT_NEAR(percentile(values, q), 100 * q, 1e-12);
}

TEST(Percentile, NoValues_IsNaN) { EXPECT_TRUE(std::isnan(percentile({}, 0.5))); }

TEST(Summarise, OneOutlier_LeavesTheMedian) {
    const TimeSummary summary = summarise({2, 2, 2, 2, 100});
    EXPECT_EQ(summary.median, 2);
    EXPECT_EQ(summary.p05, 2);
    EXPECT_GT(summary.p95, 50);
    EXPECT_EQ(summary.repeats, 5);
}

}  // namespace
}  // namespace brume::bench
