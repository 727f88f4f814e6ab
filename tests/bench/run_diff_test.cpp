// SPDX-License-Identifier: Apache-2.0
// Two runs of the benchmark: what counts as a change.
#include <gtest/gtest.h>

#include <bench/results.hpp>
#include <bench/run_diff.hpp>
#include <core/error.hpp>

#include <cmath>

namespace brume::bench {
namespace {

Row makeRow(double ms, double spread = 0.02, double yardstickMs = 10) {
    Row row;
    row.scene = "a";
    row.method = "tile";
    row.shadow = "none";
    row.width = row.height = 8;
    row.time = {ms, ms * (1 - spread), ms * (1 + spread), 20};
    row.yardstick = {yardstickMs, yardstickMs, yardstickMs, 20};
    row.bytes["total"] = 1'000'000;
    row.counters["distinctImages"] = 1;
    row.error = ErrorMetrics{.rmse = 1e-3};
    return row;
}

std::string run(const Row& row) {
    Results results;
    results.machine.device = "device";
    results.frames.push_back({.row = row});
    return toJson(results);
}

RunDiff diff(const Row& before, const Row& after, double threshold = 0.25) {
    return diffRuns(run(before), "old", run(after), "new", threshold);
}

TEST(RunDiff, SameTimes_AreNoChange) {
    const RunDiff same = diff(makeRow(10), makeRow(10.5));
    EXPECT_EQ(same.comparedRows, 1);
    EXPECT_TRUE(same.regressions.empty());
    EXPECT_TRUE(same.gains.empty());
}

TEST(RunDiff, SlowerBeyondThresholdAndSpread_IsARegression) {
    EXPECT_EQ(diff(makeRow(10), makeRow(16)).regressions.size(), 1u);
    EXPECT_EQ(diff(makeRow(16), makeRow(10)).gains.size(), 1u);
    EXPECT_TRUE(diff(makeRow(10), makeRow(16), 1.0).regressions.empty()) << "threshold";
    EXPECT_TRUE(diff(makeRow(10, 0.4), makeRow(16, 0.4)).regressions.empty()) << "spread";
}

TEST(RunDiff, AMachineThatIsSlowerAsAWhole_IsNoRegression) {
    EXPECT_TRUE(diff(makeRow(10, 0.02, 10), makeRow(18, 0.02, 18)).regressions.empty());
    EXPECT_TRUE(diff(makeRow(10, 0.02, 10), makeRow(10, 0.02, 5)).regressions.empty())
        << "a yardstick alone is no evidence";
    EXPECT_EQ(diff(makeRow(10, 0.02, 10), makeRow(18, 0.02, 10)).regressions.size(), 1u);
}

/// Rows that have become slower by factors between 1 / `most` and `most`, and one by `last`.
RunDiff diffOfMany(double most, double last) {
    Results before, after;
    constexpr int kCount = 40;
    for (int i = 0; i <= kCount; ++i) {
        Row row = makeRow(10);
        row.scene = "s" + std::to_string(i);
        before.frames.push_back({.row = row});
        const double factor = i < kCount ? std::pow(most, 2.0 * i / (kCount - 1) - 1) : last;
        Row changed = makeRow(10 * factor);
        changed.scene = row.scene;
        after.frames.push_back({.row = changed});
    }
    return diffRuns(toJson(before), "old", toJson(after), "new", 0.25);
}

TEST(RunDiff, WhereAllRowsScatter_AChangeHasToStandOut) {
    const RunDiff calm = diffOfMany(1.05, 1.6), wild = diffOfMany(1.5, 1.6);
    EXPECT_EQ(calm.regressions.size(), 1u);
    EXPECT_TRUE(wild.regressions.empty()) << formatDiff(wild);
    EXPECT_GT(wild.scatter, 0.2);
    EXPECT_EQ(diffOfMany(1.5, 5).regressions.size(), 1u) << "stands out";
    EXPECT_EQ(diff(makeRow(10), makeRow(16)).scatter, 0) << "one row has none";
}

TEST(RunDiff, HalfOfAllRowsSlower_IsNoScatter) {
    Results before, after;
    for (int i = 0; i < 40; ++i) {
        Row row = makeRow(10), changed = makeRow(i % 2 ? 25 : 10);
        row.scene = changed.scene = "s" + std::to_string(i);
        before.frames.push_back({.row = row});
        after.frames.push_back({.row = changed});
    }
    EXPECT_EQ(diffRuns(toJson(before), "old", toJson(after), "new", 0.25).regressions.size(), 20u);
}

/// Five methods on each of `scenes` scenes; all of the first `slow` scenes take `factor` times as long, and
/// the first method of the first scene `first` times.
RunDiff diffOfScenes(int scenes, int slow, double factor, double first) {
    Results before, after;
    for (int i = 0; i < scenes * 5; ++i) {
        Row row = makeRow(10);
        row.scene = "s" + std::to_string(i / 5);
        row.method = "m" + std::to_string(i % 5);
        before.frames.push_back({.row = row});
        const double times = i == 0 ? first : i / 5 < slow ? factor : 1;
        row.time = makeRow(10 * times).time;
        after.frames.push_back({.row = row});
    }
    return diffRuns(toJson(before), "old", toJson(after), "new", 0.25);
}

TEST(RunDiff, AFewDisturbedScenes_AreNotes) {
    const RunDiff one = diffOfScenes(40, 1, 1.6, 1.6);
    EXPECT_TRUE(one.regressions.empty()) << formatDiff(one);
    EXPECT_EQ(one.notes.size(), 5u);
    EXPECT_EQ(diffOfScenes(40, 1, 1.6, 2.5).regressions.size(), 1u) << "slower than its scene";
    EXPECT_EQ(diffOfScenes(40, 0, 1, 1.6).regressions.size(), 1u) << "alone";
    EXPECT_EQ(diffOfScenes(40, 1, 2.5, 2.5).regressions.size(), 5u) << "too much for a moment";
    EXPECT_EQ(diffOfScenes(40, 8, 1.6, 1.6).regressions.size(), 40u) << "too many scenes";
    EXPECT_EQ(diffOfScenes(1, 1, 1.6, 1.6).regressions.size(), 5u) << "of one";
}

TEST(RunDiff, ErrorBytesAndFailures_AreRegressionsToo) {
    Row wrong = makeRow(10), large = makeRow(10), failed = makeRow(10), nan = makeRow(10);
    wrong.error->rmse = 2e-3;
    large.bytes["total"] = 2'000'000;
    failed.failure = "no memory";
    nan.error->nonFinite = 3;
    for (const Row& worse : {wrong, large, failed, nan}) {
        EXPECT_EQ(diff(makeRow(10), worse).regressions.size(), 1u);
        EXPECT_TRUE(diff(worse, makeRow(10)).regressions.empty());
    }
}

TEST(RunDiff, RowsOfOneRunAndOtherImages_AreNotes) {
    Row other = makeRow(10);
    other.method = "sorted";
    EXPECT_EQ(diff(makeRow(10), other).notes.size(), 2u);
    Row changed = makeRow(10);
    changed.imageHash = 7;
    EXPECT_EQ(diff(makeRow(10), changed).notes.size(), 1u);
}

TEST(RunDiff, OtherFiles_AreInputErrors) {
    for (const char* text : {"", "[]", "{", "{\"rows\": 3}"})
        try {
            diffRuns(text, "old.json", run(makeRow(1)), "new.json", 0.25);
            FAIL() << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::Input);
            EXPECT_NE(std::string(error.what()).find("old.json"), std::string::npos);
        }
    // Members of unexpected kinds are skipped, not tripped over.
    EXPECT_EQ(diffRuns(R"({"rows": [1, {"scene": "a"}], "shadows": 3, "machine": 1})", "a",
                       run(makeRow(1)), "b", 0.25)
                  .comparedRows,
              0);
}

}  // namespace
}  // namespace brume::bench
