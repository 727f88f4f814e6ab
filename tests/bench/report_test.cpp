// SPDX-License-Identifier: Apache-2.0
// Tables and files that people read after a benchmark.
#include <gtest/gtest.h>

#include <bench/pareto.hpp>
#include <bench/report.hpp>
#include <bench/svg.hpp>
#include <core/error.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace brume::bench {
namespace {

class ReportTest : public testing::Test {
  protected:
    void SetUp() override { std::filesystem::remove_all(mFolder); }
    void TearDown() override { std::filesystem::remove_all(mFolder); }

    static std::string read(const std::filesystem::path& file) {
        std::ifstream stream(file);
        std::stringstream text;
        text << stream.rdbuf();
        return text.str();
    }

    const std::filesystem::path mFolder =
        std::filesystem::temp_directory_path() /
        (std::string("brume_report_") +
         testing::UnitTest::GetInstance()->current_test_info()->name());
};

Measurement makeMeasurement() {
    Measurement m;
    m.row.scene = "../layers";
    m.row.method = "linked_list";
    m.row.width = m.row.height = 2;
    m.row.time = {12.5, 12, 13, 20};
    m.row.error = ErrorMetrics{.rmse = 1.5e-6};
    m.image = Image(2, 2, vec3(0.5f));
    m.absolute = {0, 0, 1e-3f, 1};
    return m;
}

TEST_F(ReportTest, Table_HasOneAlignedLinePerRow) {
    Measurement failed = makeMeasurement();
    failed.row.failure = "out of memory";
    const std::vector<Measurement> rows = {makeMeasurement(), failed};
    std::istringstream table(formatTable(rows));
    std::vector<std::string> lines;
    for (std::string line; std::getline(table, line);) lines.push_back(line);
    ASSERT_EQ(lines.size(), 4u);
    for (const std::string& line : lines) EXPECT_EQ(line.size(), lines[0].size());
    EXPECT_NE(lines[2].find("12.50"), std::string::npos);
    EXPECT_NE(lines[2].find("1.50e-06"), std::string::npos);
    EXPECT_NE(lines[3].find("failed"), std::string::npos);
}

std::size_t count(const std::string& text, const std::string& what) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; ++at) ++found;
    return found;
}

Results makeResults() {
    Results results;
    results.machine.device = "a <device>";
    results.command = "brume bench --scenes 'a b'";
    Measurement m = makeMeasurement();
    m.reference = std::make_shared<const Image>(2, 2, vec3(0.25f));
    m.row.command = "brume bench --scenes ../layers --methods linked_list";
    m.row.passes = {{"oit.linked_list.resolve", {1, 1, 1, 3}, 1000, 20, 0.5}};
    results.frames = {m, m};
    results.frames[1].row.method = "weighted";
    results.frames[1].row.time.median = 6;
    results.frames[1].row.error->rmse = 0.1;
    results.findings = {{.suite = "sweeps",
                         .summary = "growth",
                         .tables = {{.title = "t", .header = {"a"}, .rows = {{"1"}}}},
                         .plots = {{"time", "x", "ms", {{"tile", {{1, 1}, {10, 20}}}}}}}};
    return results;
}

TEST_F(ReportTest, WriteReport_HoldsTablesPlotsPicturesAndCommandsInOnePage) {
    writeReport(mFolder, makeResults());
    const std::string page = read(mFolder / "report.html");
    EXPECT_EQ(count(page, "<svg"), 2u) << "a sweep and error against time";
    EXPECT_EQ(count(page, "data:image/png;base64,iVBOR"), 5u) << "a reference, two results, two errors";
    EXPECT_NE(page.find("a &lt;device&gt;"), std::string::npos);
    EXPECT_NE(page.find("brume bench --scenes ../layers --methods linked_list"), std::string::npos);
    EXPECT_NE(page.find("oit.linked_list.resolve"), std::string::npos);
    for (const char* outside : {"http:", "https:", "href=", "src='/", "@import"})
        EXPECT_EQ(page.find(outside), std::string::npos) << outside;
    EXPECT_EQ(page.find("nan"), std::string::npos);
    EXPECT_NE(read(mFolder / "report.md").find("## sweeps: growth"), std::string::npos);
    EXPECT_GT(std::filesystem::file_size(mFolder / "rows.json"), 0u);
}

TEST_F(ReportTest, WriteTextFile_ReplacesWholeFilesAndLeavesNothingBeside) {
    std::filesystem::create_directories(mFolder);
    writeTextFile(mFolder / "a.json", "long text");
    writeTextFile(mFolder / "a.json", "short");
    EXPECT_EQ(read(mFolder / "a.json"), "short");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(mFolder), {}), 1);
}

TEST_F(ReportTest, WriteTextFile_WithoutFolder_IsAFailure) {
    try {
        writeTextFile(mFolder / "missing" / "a.json", "text");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Failure);
    }
}

Measurement makeTimed(const char* scene, const char* method, double ms, double rmse) {
    Measurement m;
    m.row.scene = scene;
    m.row.method = method;
    m.row.time = {ms, ms, ms, 1};
    m.row.error = ErrorMetrics{.rmse = rmse};
    return m;
}

TEST(Pareto, Front_HoldsWhatNoOtherBeatsInBoth) {
    const std::vector<Measurement> rows = {
        makeTimed("a", "exact", 10, 1e-6),   makeTimed("a", "fast", 1, 0.1),
        makeTimed("a", "slow_wrong", 5, 0.2), makeTimed("a", "middle", 3, 0.01),
        makeTimed("b", "slow_wrong", 1, 0.2), makeTimed("b", "fast", 0.5, 0.1)};
    EXPECT_EQ(findParetoFront(rows, "a 0x0"), (std::vector<std::size_t>{1, 3, 0}));
    EXPECT_EQ(findParetoFront(rows, "b 0x0"), (std::vector<std::size_t>{5}));
    EXPECT_EQ(findDominated(rows), (std::set<std::string>{"slow_wrong"}));
}

TEST(Pareto, RowsWithoutErrorOrMeasurement_AreLeftOut) {
    std::vector<Measurement> rows = {makeTimed("a", "failed", 1, 0), makeTimed("a", "blind", 2, 0),
                                     makeTimed("a", "good", 3, 0)};
    rows[0].row.failure = "out of memory";
    rows[1].row.error.reset();
    EXPECT_EQ(findParetoFront(rows, "a 0x0"), (std::vector<std::size_t>{2}));
    EXPECT_TRUE(findDominated(rows).empty());
}

TEST(Pareto, Plot_NamesEveryRivalAndNeedsTwo) {
    const std::vector<Measurement> rows = {makeTimed("a<b", "exact", 10, 0),
                                           makeTimed("a<b", "f<st", 1, 0.1),
                                           makeTimed("c", "fast", 1, 0.1)};
    const std::string plot = drawParetoPlot(rows, "a<b 0x0");
    EXPECT_NE(plot.find("f&lt;st"), std::string::npos);
    EXPECT_EQ(plot.find("nan"), std::string::npos);
    EXPECT_TRUE(drawParetoPlot(rows, "c 0x0").empty());
}

TEST(Table, Exponent_IsThatOfThePower) {
    EXPECT_NEAR(fitExponent({{1, 3}, {2, 12}, {8, 192}}), 2, 1e-12);
    EXPECT_TRUE(std::isnan(fitExponent({{2, 3}, {2, 4}})));
    EXPECT_TRUE(std::isnan(fitExponent({})));
}

TEST(Table, Cells_AreAlignedByCharacters) {
    const Table table{.header = {"µ", "long header"}, .rows = {{"1"}, {"ab", "2"}}};
    std::istringstream text(formatCells(table));
    std::string line, first;
    std::getline(text, first);
    while (std::getline(text, line)) EXPECT_EQ(line.size(), first.size() - 1) << line;
}

}  // namespace
}  // namespace brume::bench
