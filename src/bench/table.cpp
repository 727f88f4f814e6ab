// SPDX-License-Identifier: Apache-2.0
#include <bench/table.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace brume::bench {
namespace {

/// Characters, not bytes.
std::size_t measureWidth(const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

std::string formatLine(const Cells& cells, const std::vector<std::size_t>& widths,
                       std::size_t textColumns) {
    std::string line = "|";
    for (std::size_t i = 0; i < widths.size(); ++i) {
        const std::string cell = i < cells.size() ? cells[i] : "-";
        const std::string space(widths[i] - measureWidth(cell), ' ');
        line += i < textColumns ? " " + cell + space + " |" : " " + space + cell + " |";
    }
    return line + "\n";
}

}  // namespace

std::string formatCells(const Table& table) {
    std::vector<std::size_t> widths;
    for (const std::string& cell : table.header)
        widths.push_back(std::max<std::size_t>(measureWidth(cell), 1));
    for (const Cells& cells : table.rows)
        for (std::size_t i = 0; i < std::min(cells.size(), widths.size()); ++i)
            widths[i] = std::max(widths[i], measureWidth(cells[i]));
    std::string text = formatLine(table.header, widths, table.textColumns) + "|";
    for (std::size_t i = 0; i < widths.size(); ++i) {
        const std::string dashes(widths[i], '-');
        text += i < table.textColumns ? fmt::format(":{}-|", dashes) : fmt::format("-{}:|", dashes);
    }
    text += "\n";
    for (const Cells& cells : table.rows) text += formatLine(cells, widths, table.textColumns);
    return text;
}

std::string formatMarkdown(const Table& table) {
    std::string text = fmt::format("### {}\n\n{}\n", table.title, formatCells(table));
    for (const std::string& note : table.notes) text += "* " + note + "\n";
    return table.notes.empty() ? text : text + "\n";
}

double fitExponent(const std::vector<dvec2>& points) {
    dvec2 mean(0);
    for (const dvec2& p : points) mean += glm::log(p) / static_cast<double>(points.size());
    double covariance = 0, variance = 0;
    for (const dvec2& p : points) {
        const dvec2 offset = glm::log(p) - mean;
        covariance += offset.x * offset.y;
        variance += offset.x * offset.x;
    }
    return variance > 0 ? covariance / variance : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace brume::bench
