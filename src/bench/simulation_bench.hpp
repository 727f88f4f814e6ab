// SPDX-License-Identifier: Apache-2.0
// What the particle simulator costs, beside a plain copy of the same bytes in the same run.
#pragma once

#include <bench/statistics.hpp>
#include <bench/table.hpp>
#include <gpu/device.hpp>
#include <span>
#include <string>
#include <vector>

namespace brume::bench {

struct SimulationCost {
    std::string name;
    TimeSummary time;      ///< ms; one of twenty is faster than p05: what a quiet machine takes
    double copyRatio = 0;  ///< to the copy of 40 bytes per particle: median over the rounds
    double perSecond = 0;  ///< particles or pairs, by the median
    std::string command;   ///< that measures this and the others again, for a shell
};

/// Measures ticks of `particleCount` living particles (without modules; gravity and drag, of one
/// instance and of 1 000 with a thousandth each; and curl noise), one in which half of them die, the sort of as many pairs, and the copy; `repeats` rounds
/// of all of them in turn. Throws a failure Error if memory is short.
std::vector<SimulationCost> measureSimulation(gpu::Device& device, std::uint32_t particleCount,
                                              int repeats);

Table makeSimulationTable(std::span<const SimulationCost> costs);

}  // namespace brume::bench
