// SPDX-License-Identifier: Apache-2.0
// Findings as people read them: tables and plots, as Markdown and as parts of a page.
#pragma once

#include <core/math.hpp>

#include <string>
#include <vector>

namespace brume::bench {

using Cells = std::vector<std::string>;

struct Table {
    std::string title;
    std::vector<std::string> notes;  ///< sentences below it
    Cells header;
    std::vector<Cells> rows;     ///< as long as the header; shorter ones are filled with "-"
    std::size_t textColumns = 1;  ///< so many from the left are flush left, the others flush right
};

/// Aligned; also valid Markdown. Without title and notes.
std::string formatCells(const Table& table);
/// With its title as a heading and its notes.
std::string formatMarkdown(const Table& table);

/// Values over values, both axes logarithmic.
struct Series {
    std::string name;
    std::vector<dvec2> points;  ///< positive
};
struct Plot {
    std::string title, xLabel, yLabel;
    std::vector<Series> series;
};

/// What is said about a suite's rows.
struct Findings {
    std::string suite, summary;
    std::vector<Table> tables;
    std::vector<Plot> plots;
};

/// Of y = c x^e, fitted by least squares to the logarithms; NaN for fewer than two different x.
double fitExponent(const std::vector<dvec2>& points);

}  // namespace brume::bench
