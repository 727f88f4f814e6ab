// SPDX-License-Identifier: Apache-2.0
// Everything that one run of the benchmark has found.
#pragma once

#include <bench/machine.hpp>
#include <bench/measure.hpp>
#include <bench/shadow_measure.hpp>
#include <bench/simulation_bench.hpp>
#include <bench/table.hpp>

#include <span>
#include <string>
#include <vector>

namespace brume::bench {

struct Results {
    Machine machine;
    std::vector<Measurement> frames;
    std::vector<ShadowRow> shadows;
    std::vector<SimulationCost> simulation;
    std::vector<Findings> findings;
    std::string command;  ///< that was given, for a shell
};

/// {"machine": {...}, "command": "...", "rows": [...], "shadows": [...], "simulation": [...]}; the
/// last two only if there are any.
std::string toJson(const Results& results);

/// One line each: device, processor, rates.
std::string describeMachine(const Machine& machine);

/// First line of every failure, "<scene> by <method>: <what>".
std::vector<std::string> listFailures(const Results& results);

}  // namespace brume::bench
