// SPDX-License-Identifier: Apache-2.0
// Error against time: which methods are worth their time, and a page that shows it.
#pragma once

#include <bench/measure.hpp>
#include <set>
#include <span>
#include <string>

namespace brume::bench {

/// Indices of the rows of one scene that no other row of it beats in both time and rmse, fastest
/// first. Rows that failed or were not compared are left out.
std::vector<std::size_t> findParetoFront(std::span<const Measurement> measurements,
                                         const std::string& scene);

/// Methods that were compared on at least one scene and are on the front of none.
std::set<std::string> findDominated(std::span<const Measurement> measurements);

/// One HTML page that needs no other file: for each scene a plot of rmse against milliseconds, both
/// logarithmic, with the front as a line; then the table `table` (Markdown).
std::string makeParetoPage(std::span<const Measurement> measurements, const std::string& title,
                           const std::string& table);

}  // namespace brume::bench
