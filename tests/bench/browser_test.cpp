// SPDX-License-Identifier: Apache-2.0
// The report in a real browser (Debian's chromium): it opens without errors and without a network, the
// plots are there, and tables sort.
#include <gtest/gtest.h>

#include <bench/report.hpp>

#include <unistd.h>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

namespace brume::bench {
namespace {

class BrowserTest : public testing::Test {
  protected:
    void SetUp() override {
        if (std::system("command -v chromium >/dev/null 2>&1") != 0)
            GTEST_SKIP() << "no chromium, which scripts/setup installs";
        std::filesystem::create_directories(mFolder);
    }
    void TearDown() override {
        std::error_code ignored;
        std::filesystem::remove_all(mFolder, ignored);
    }

    /// The page as the browser has made it, with what it said on the console.
    struct Opened {
        std::string dom, log;
    };
    Opened open(const std::string& fragment) const {
        const std::string log = (mFolder / "log").string();
        const std::string command =
            "HOME=" + mFolder.string() + " timeout 100 chromium --headless --no-sandbox --disable-gpu " +
            "--enable-logging=stderr --host-resolver-rules='MAP * ~NOTFOUND' --user-data-dir=" +
            (mFolder / "profile").string() + " --virtual-time-budget=5000 --dump-dom 'file://" +
            (mFolder / "report.html").string() + fragment + "' 2>" + log;
        Opened opened;
        FILE* pipe = popen(command.c_str(), "r");
        char buffer[4096];
        for (std::size_t count; (count = fread(buffer, 1, sizeof buffer, pipe)) > 0;)
            opened.dom.append(buffer, count);
        pclose(pipe);
        std::ifstream stream(log);
        std::stringstream text;
        text << stream.rdbuf();
        opened.log = text.str();
        return opened;
    }

    const std::filesystem::path mFolder = std::filesystem::temp_directory_path() /
                                          ("brume_browser_" + std::to_string(::getpid()));
};

Results makeResults() {
    Results results;
    for (const double ms : {9.0, 100.0, 20.0}) {
        Measurement m;
        m.row.scene = "scene";
        m.row.method = "method " + std::to_string(static_cast<int>(ms));
        m.row.width = m.row.height = 4;
        m.row.time = {ms, ms, ms, 3};
        m.row.error = ErrorMetrics{.rmse = 1 / ms};
        m.image = Image(4, 4, vec3(0.5f));
        m.absolute.assign(16, 1e-3f);
        m.reference = std::make_shared<const Image>(4, 4, vec3(0.4f));
        results.frames.push_back(m);
    }
    results.findings = {
        {.suite = "s", .plots = {{"growth", "x", "ms", {{"tile", {{1, 1}, {10, 20}}}}}}}};
    return results;
}

/// First cells of the rows that begin with "scene", by the ms of the fifth column.
std::vector<double> readTimes(const std::string& dom) {
    const std::size_t begin = dom.find("id=\"table-0\"");
    const std::string table = dom.substr(begin, dom.find("</table>", begin) - begin);
    static const std::regex kRow("<tr>(?:<td[^>]*>[^<]*</td>){4}<td[^>]*>([0-9.]+)</td>");
    std::vector<double> times;
    for (std::sregex_iterator row(table.begin(), table.end(), kRow), end; row != end; ++row)
        times.push_back(std::stod((*row)[1]));
    return times;
}

TEST_F(BrowserTest, Report_OpensWithoutErrorsAndSorts) {
    writeReport(mFolder, makeResults());
    const Opened plain = open("");
    EXPECT_NE(plain.dom.find("data-ready=\"yes\""), std::string::npos) << plain.log;
    EXPECT_EQ(plain.log.find("CONSOLE"), std::string::npos) << plain.log;
    EXPECT_EQ(readTimes(plain.dom), (std::vector<double>{9, 100, 20}));
    std::size_t plots = 0;
    for (std::size_t at = 0; (at = plain.dom.find("<svg", at)) != std::string::npos; ++at) ++plots;
    EXPECT_EQ(plots, 2u);
    const Opened sorted = open("#sort=table-0:4");
    EXPECT_EQ(readTimes(sorted.dom), (std::vector<double>{9, 20, 100})) << "numbers, not letters";
    EXPECT_EQ(sorted.log.find("CONSOLE"), std::string::npos) << sorted.log;
}

}  // namespace
}  // namespace brume::bench
