// SPDX-License-Identifier: Apache-2.0
// From plans to results.
#pragma once

#include <bench/scenes.hpp>
#include <bench/suites/suite.hpp>

#include <functional>

namespace brume::bench {

struct RunOptions {
    int repeats = 20;  ///< where a plan does not say
    int shortRepeats = 0;  ///< MeasureOptions::shortRepeats
    bool withError = true;
    int errorEvery = 1;       ///< errors at the middle one of each n x n pixels
    bool keepImages = false;  ///< small ones, for the report
    /// Scenes by the names in the plans; several for families such as `layers`.
    std::function<std::vector<NamedScene>(const std::string&)> findScenes = [](const auto& name) {
        return makeScenes(name);
    };
    /// Told what is being measured and how much of everything is done, before each plan.
    std::function<void(const std::string& what, double fraction)> progress;
};

/// Measures the plans one after the other and adds their rows, of suite `suite`, to the results.
/// Throws an input Error for an unknown scene, method, store or setting; a device that fails at a row
/// makes a row that says so.
void runPlans(gpu::Device& device, Yardstick& yardstick, const std::vector<Plan>& plans,
              const std::string& suite, const RunOptions& options, const Log& log,
              Results& results);

/// Measures a suite and reads its rows into findings.
void runSuite(gpu::Device& device, Yardstick& yardstick, const Suite& suite, Scale scale,
              const RunOptions& options, const Log& log, Results& results);

}  // namespace brume::bench
