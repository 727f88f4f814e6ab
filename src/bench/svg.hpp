// SPDX-License-Identifier: Apache-2.0
// Plots on logarithmic axes as SVG, to be put into a page.
#pragma once

#include <bench/table.hpp>

#include <string>
#include <vector>

namespace brume::bench {

/// A point with its name beside it.
struct Mark {
    dvec2 at{1};
    std::string name;
    std::string hint;  ///< shown under the pointer
    bool isBest = false;
};

/// Marks, and a line through `front`. Empty for no marks; all values must be positive and finite.
std::string drawMarks(const std::string& xLabel, const std::string& yLabel,
                      const std::vector<Mark>& marks, const std::vector<dvec2>& front);

/// A line with dots per series, its name at its end.
std::string drawPlot(const Plot& plot);

/// A plot as a file of its own, for documents: with its title, light and dark readers see the same.
std::string drawPlotFile(const Plot& plot);

/// For text and attributes of HTML.
std::string escapeHtml(const std::string& text);

}  // namespace brume::bench
