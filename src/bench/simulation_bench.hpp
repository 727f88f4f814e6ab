// SPDX-License-Identifier: Apache-2.0
// What the particle simulator costs, beside a plain copy of the same bytes in the same run.
#pragma once

#include <gpu/device.hpp>
#include <string>
#include <vector>

namespace brume::bench {

struct SimulationCost {
    std::string name;
    double timeMs = 0;     ///< median
    double p05Ms = 0;      ///< one of twenty is faster: what a quiet machine takes
    double copyRatio = 0;  ///< to the copy of 40 bytes per particle: median over the rounds
    double perSecond = 0;  ///< particles or pairs, by the median
};

/// Measures ticks of `particleCount` living particles (without modules; gravity and drag, of one
/// instance and of 1 000 with a thousandth each; and curl noise), one in which half of them die, the sort of as many pairs, and the copy; `repeats` rounds
/// of all of them in turn. Throws a failure Error if memory is short.
std::vector<SimulationCost> measureSimulation(gpu::Device& device, std::uint32_t particleCount,
                                              int repeats);

/// As an aligned table; also valid Markdown.
std::string formatTable(const std::vector<SimulationCost>& costs);

}  // namespace brume::bench
