// SPDX-License-Identifier: Apache-2.0
// Error against time: which methods are worth their time.
#pragma once

#include <bench/measure.hpp>

#include <set>
#include <span>
#include <string>

namespace brume::bench {

/// What rows must share to be rivals: "mixed 640x360", with the shadow store if there is one.
std::string describeGroup(const Row& row);

/// Indices of the rows of one group that no other row of it beats in both time and rmse, fastest
/// first. Rows that failed or were not compared are left out.
std::vector<std::size_t> findParetoFront(std::span<const Measurement> measurements,
                                         const std::string& group);

/// Methods that were compared in at least one group and are on the front of none.
std::set<std::string> findDominated(std::span<const Measurement> measurements);

/// rmse against milliseconds of a group, both logarithmic, with the front as a line; empty for fewer
/// than two rows that were compared.
std::string drawParetoPlot(std::span<const Measurement> measurements, const std::string& group);

}  // namespace brume::bench
