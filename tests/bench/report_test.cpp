// SPDX-License-Identifier: Apache-2.0
// Tables and files that people read after a benchmark.
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace brume::bench
