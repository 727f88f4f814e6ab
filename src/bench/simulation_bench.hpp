// SPDX-License-Identifier: Apache-2.0
// What the particle simulator costs, beside a plain copy of the same bytes in the same run.
#pragma once

#include <gpu/device.hpp>
#include <string>
#include <vector>

namespace brume::bench {

struct SimulationCost {
    std::string name;
    double timeMs = 0;       ///< median
    double copyRatio = 0;    ///< to the copy of 40 bytes per particle
    double perSecond = 0;    ///< particles or pairs
};

/// Measures ticks of `particleCount` living particles (without modules; gravity and drag, of one
/// instance and of 1 000 with a thousandth each; and curl noise), the sort of as many pairs, and the
/// copy. Throws a failure Error if memory is short.
std::vector<SimulationCost> measureSimulation(gpu::Device& device, std::uint32_t particleCount,
                                              int repeats);

/// As an aligned table; also valid Markdown.
std::string formatTable(const std::vector<SimulationCost>& costs);

}  // namespace brume::bench
