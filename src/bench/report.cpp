// SPDX-License-Identifier: Apache-2.0
#include <bench/pareto.hpp>
#include <bench/report.hpp>
#include <bench/svg.hpp>
#include <core/error.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>

namespace brume::bench {
namespace {

std::uint64_t findOr0(const std::map<std::string, std::uint64_t>& counts, const std::string& name) {
    const auto found = counts.find(name);
    return found == counts.end() ? 0 : found->second;
}

Cells makeCells(const Row& row) {
    Cells cells = {row.scene, row.method, row.shadow,
                   fmt::format("{}x{}", row.width, row.height)};
    if (!row.failure.empty()) {
        cells.push_back("failed");
        return cells;
    }
    const double pixels = static_cast<double>(row.width) * row.height;
    cells.push_back(fmt::format("{:.2f}", row.time.median));
    cells.push_back(fmt::format("{:.2f}..{:.2f}", row.time.p05, row.time.p95));
    cells.push_back(fmt::format("{:.2f}", row.wall.median));
    cells.push_back(
        row.layerPixelsPerSecond ? fmt::format("{:.1f}", *row.layerPixelsPerSecond * 1e-6) : "-");
    cells.push_back(
        fmt::format("{:.1f}", static_cast<double>(findOr0(row.bytes, "total")) / pixels));
    cells.push_back(
        fmt::format("{:.1f} MB", static_cast<double>(findOr0(row.bytes, "lists")) * 1e-6));
    cells.push_back(fmt::format("{}", findOr0(row.counters, "stored")));
    for (double ErrorMetrics::*figure : {&ErrorMetrics::rmse, &ErrorMetrics::max, &ErrorMetrics::bias,
                                         &ErrorMetrics::p999, &ErrorMetrics::flip})
        cells.push_back(row.error ? fmt::format("{:.2e}", (*row.error).*figure) : "-");
    cells.push_back(row.error ? fmt::format("{:.1f}", row.error->psnr) : "-");
    cells.push_back(row.error ? fmt::format("{}", row.error->nonFinite) : "-");
    return cells;
}

}  // namespace

Table makeRowTable(std::span<const Measurement> measurements) {
    Table table{.title = "Every row",
                .header = {"scene", "method", "shadow", "size", "ms", "p05..p95", "wall ms",
                           "Mlayer-px/s", "bytes/px", "lists", "stored", "rmse", "max", "bias",
                           "p99.9", "flip", "psnr", "not finite"},
                .textColumns = 2};
    for (const Measurement& m : measurements) table.rows.push_back(makeCells(m.row));
    return table;
}

Table makePassTable(std::span<const Measurement> measurements) {
    Table table{.title = "Every pass beside its roofline",
                .notes = {"Roof: the longer of the times that its bytes take at the measured bandwidth "
                          "and its fragments at the measured fill rate. Bytes: all that it declares to "
                          "read and to write, once each; fragments: shader invocations, of which "
                          "software devices count whole blocks; a pass that touches part of its bytes may stay "
                          "below the roof, one that computes much is far above it."},
                .header = {"scene", "method", "pass", "ms", "p05..p95", "MB", "fragments", "roof ms",
                           "ms / roof"},
                .textColumns = 3};
    for (const Measurement& m : measurements)
        for (const PassRow& pass : m.row.passes)
            table.rows.push_back(
                {m.row.scene, m.row.method, pass.name, fmt::format("{:.3f}", pass.time.median),
                 fmt::format("{:.3f}..{:.3f}", pass.time.p05, pass.time.p95),
                 fmt::format("{:.2f}", 1e-6 * static_cast<double>(pass.bytes)),
                 std::to_string(pass.fragments), fmt::format("{:.3f}", pass.roofMs),
                 pass.roofMs > 0 ? fmt::format("{:.1f}", pass.time.median / pass.roofMs) : "-"});
    return table;
}

std::string formatTable(std::span<const Measurement> measurements) {
    return formatCells(makeRowTable(measurements));
}

void writeReport(const std::filesystem::path& folder, const Results& results) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw failure("writing report", folder.string(), error.message());
    std::string text = fmt::format("# Benchmark\n\n{}.\n\nTimes are medians. Made by\n\n    {}\n\n",
                                   describeMachine(results.machine), results.command);
    const std::set<std::string> dominated = findDominated(results.frames);
    if (!dominated.empty())
        text += fmt::format("Beaten in both time and rmse on every scene here: {}.\n\n",
                            fmt::join(dominated, ", "));
    int plotCount = 0;
    for (const Findings& findings : results.findings) {
        text += fmt::format("## {}: {}\n\n", findings.suite, findings.summary);
        for (const Table& table : findings.tables) text += formatMarkdown(table) + "\n";
        for (const Plot& plot : findings.plots) {
            const std::string name = fmt::format("plot_{}.svg", plotCount++);
            writeTextFile(folder / name, drawPlotFile(plot));
            text += fmt::format("![{}]({})\n\n", plot.title, name);
        }
    }
    text += formatMarkdown(makeRowTable(results.frames));
    writeTextFile(folder / "report.md", text);
    writeTextFile(folder / "report.html", makePage(results));
    writeTextFile(folder / "rows.json", toJson(results));
}

void writeTextFile(const std::filesystem::path& file, const std::string& text) {
    const std::filesystem::path beside = file.string() + ".part";
    std::ofstream stream(beside, std::ios::binary);
    stream << text;
    stream.close();
    std::error_code error;
    if (stream) std::filesystem::rename(beside, file, error);
    if (!stream || error) {
        std::error_code ignored;
        std::filesystem::remove(beside, ignored);
        throw failure(
            "writing file", file.string(),
            error ? error.message() : "cannot be written, is the folder there and writable?");
    }
}

}  // namespace brume::bench
