// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bench/pareto.hpp>
#include <bench/report.hpp>
#include <core/error.hpp>
#include <core/image_io.hpp>
#include <fstream>

namespace brume::bench {
namespace {

using Cells = std::vector<std::string>;

Cells makeHeader() {
    return {"scene",    "method", "size",   "ms",   "p05..p95", "Mlayer-px/s",
            "bytes/px", "lists",  "stored", "rmse", "max",      "flip"};
}

std::uint64_t findOr0(const std::map<std::string, std::uint64_t>& counts, const std::string& name) {
    const auto found = counts.find(name);
    return found == counts.end() ? 0 : found->second;
}

Cells makeCells(const Row& row) {
    Cells cells = {row.scene, row.method, fmt::format("{}x{}", row.width, row.height)};
    if (!row.failure.empty()) {
        cells.push_back("failed");
        cells.resize(makeHeader().size(), "-");
        return cells;
    }
    const double pixels = static_cast<double>(row.width) * row.height;
    cells.push_back(fmt::format("{:.2f}", row.time.median));
    cells.push_back(fmt::format("{:.2f}..{:.2f}", row.time.p05, row.time.p95));
    cells.push_back(
        row.layerPixelsPerSecond ? fmt::format("{:.1f}", *row.layerPixelsPerSecond * 1e-6) : "-");
    cells.push_back(
        fmt::format("{:.1f}", static_cast<double>(findOr0(row.bytes, "total")) / pixels));
    cells.push_back(
        fmt::format("{:.1f} MB", static_cast<double>(findOr0(row.bytes, "lists")) * 1e-6));
    cells.push_back(fmt::format("{}", findOr0(row.counters, "stored")));
    for (double ErrorMetrics::*figure :
         {&ErrorMetrics::rmse, &ErrorMetrics::max, &ErrorMetrics::flip})
        cells.push_back(row.error ? fmt::format("{:.2e}", (*row.error).*figure) : "-");
    return cells;
}

std::string formatLine(const Cells& cells, const std::vector<std::size_t>& widths) {
    std::string line = "|";
    for (std::size_t i = 0; i < cells.size(); ++i)
        line += i < 2 ? fmt::format(" {:<{}} |", cells[i], widths[i])
                      : fmt::format(" {:>{}} |", cells[i], widths[i]);
    return line + "\n";
}

/// "layers_2_800x600.linked_list", with nothing that would leave the folder.
std::string makeFileStem(const Row& row) {
    std::string stem = row.scene + "." + row.method;
    std::replace_if(
        stem.begin(), stem.end(),
        [](unsigned char c) { return !std::isalnum(c) && c != '.' && c != '_'; }, '_');
    return stem;
}

}  // namespace

std::string formatTable(std::span<const Measurement> measurements) {
    std::vector<Cells> lines = {makeHeader()};
    for (const Measurement& m : measurements) lines.push_back(makeCells(m.row));
    std::vector<std::size_t> widths(lines[0].size());
    for (const Cells& cells : lines)
        for (std::size_t i = 0; i < cells.size(); ++i)
            widths[i] = std::max(widths[i], cells[i].size());
    std::string table = formatLine(lines[0], widths) + "|";
    for (std::size_t i = 0; i < widths.size(); ++i) {
        const std::string dashes(widths[i], '-');
        table += i < 2 ? fmt::format(":{}-|", dashes) : fmt::format("-{}:|", dashes);
    }
    table += "\n";
    for (std::size_t i = 1; i < lines.size(); ++i) table += formatLine(lines[i], widths);
    return table;
}

void writeReport(const std::filesystem::path& folder, std::span<const Measurement> measurements) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw failure("writing report", folder.string(), error.message());
    std::string text = "# Benchmark\n\n", title = "Benchmark";
    if (!measurements.empty()) {
        const Row& first = measurements.front().row;
        title = fmt::format("Brume {} ({}) on {} ({})", version(), first.commit, first.device,
                            first.driver);
        text += title + ". Times are medians.\n\n";
    }
    const std::set<std::string> dominated = findDominated(measurements);
    if (!dominated.empty())
        text += fmt::format("Beaten in both time and rmse on every scene here: {}.\n\n",
                            fmt::join(dominated, ", "));
    text += formatTable(measurements) + "\n";
    std::vector<Row> rows;
    for (const Measurement& m : measurements) {
        rows.push_back(m.row);
        const std::string stem = makeFileStem(m.row);
        text += fmt::format("## {} by {}\n\n", m.row.scene, m.row.method);
        if (!m.row.failure.empty()) text += m.row.failure + "\n\n";
        if (!m.image.isEmpty()) {
            writeImage(folder / (stem + ".png"), m.image);
            text += fmt::format("![image]({}.png)\n", stem);
        }
        if (!m.absolute.empty()) {
            writeImage(folder / (stem + ".error.png"),
                       paintErrors(m.absolute, m.image.width, m.image.height));
            text += fmt::format("![error, black 1e-6 to white 1]({}.error.png)\n", stem);
        }
        text += "\n";
    }
    writeTextFile(folder / "report.md", text);
    writeTextFile(folder / "report.html",
                  makeParetoPage(measurements, title, formatTable(measurements)));
    writeTextFile(folder / "rows.json", toJson(rows, "rows"));
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
