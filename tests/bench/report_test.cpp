// SPDX-License-Identifier: Apache-2.0
// Tables and files that people read after a benchmark.
#include <gtest/gtest.h>

#include <bench/pareto.hpp>
#include <bench/report.hpp>
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

TEST_F(ReportTest, WriteReport_StaysInItsFolderAndNamesItsPictures) {
    const std::vector<Measurement> rows = {makeMeasurement()};
    writeReport(mFolder, rows);
    const std::string report = read(mFolder / "report.md");
    EXPECT_NE(report.find("(.._layers.linked_list.png)"), std::string::npos);
    for (const char* file :
         {".._layers.linked_list.png", ".._layers.linked_list.error.png", "rows.json"})
        EXPECT_GT(std::filesystem::file_size(mFolder / file), 0u) << file;
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
    EXPECT_EQ(findParetoFront(rows, "a"), (std::vector<std::size_t>{1, 3, 0}));
    EXPECT_EQ(findParetoFront(rows, "b"), (std::vector<std::size_t>{5}));
    EXPECT_EQ(findDominated(rows), (std::set<std::string>{"slow_wrong"}));
}

TEST(Pareto, RowsWithoutErrorOrMeasurement_AreLeftOut) {
    std::vector<Measurement> rows = {makeTimed("a", "failed", 1, 0), makeTimed("a", "blind", 2, 0),
                                     makeTimed("a", "good", 3, 0)};
    rows[0].row.failure = "out of memory";
    rows[1].row.error.reset();
    EXPECT_EQ(findParetoFront(rows, "a"), (std::vector<std::size_t>{2}));
    EXPECT_TRUE(findDominated(rows).empty());
}

TEST(Pareto, Page_DrawsEverySceneAndNeedsNothingElse) {
    const std::vector<Measurement> rows = {makeTimed("a<b", "exact", 10, 0),
                                           makeTimed("a<b", "fast", 1, 0.1),
                                           makeTimed("c", "fast", 1, 0.1)};
    const std::string page = makeParetoPage(rows, "Brume & co", "| table |");
    EXPECT_NE(page.find("a&lt;b"), std::string::npos);
    EXPECT_NE(page.find("Brume &amp; co"), std::string::npos);
    EXPECT_NE(page.find("| table |"), std::string::npos);
    EXPECT_EQ(page.find("nan"), std::string::npos);
    for (const char* outside : {"http:", "https:", "src=", "href=", "<script"})
        EXPECT_EQ(page.find(outside), std::string::npos) << outside;
    std::size_t plots = 0;
    for (std::size_t at = 0; (at = page.find("<svg", at)) != std::string::npos; ++at) ++plots;
    EXPECT_EQ(plots, 2u);
}

}  // namespace
}  // namespace brume::bench
