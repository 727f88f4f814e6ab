// SPDX-License-Identifier: Apache-2.0
// One quantity varied with everything else kept: the plans of its places, and what their rows say.
#pragma once

#include <bench/suites/suite.hpp>

namespace brume::bench {

/// One measured place on an axis.
struct Stop {
    double x = 0;
    std::string scene;
    ivec2 size{0};
    std::string shadow;
    scene::Settings settings;
    std::string setting;  ///< appended to the words of the methods: ":samples=4"
    std::string truth = {};
};

enum class Figure { Ms, Rmse };

struct Sweep {
    std::string title;  ///< "particles"
    std::string xLabel;
    std::vector<std::string> methods;
    std::vector<Stop> stops;
    std::vector<Figure> figures = {Figure::Ms};
};

/// "spheres_10k_4": 10k is how names of scenes write 10 000, 1m a million.
std::string formatCount(int count);

/// "1000 .. 16000"
std::string formatRange(double from, double to);

std::vector<Plan> planSweeps(std::span<const Sweep> sweeps);

/// A plot per figure, and a table of the exponents, fitted and between the last two places.
Findings readSweeps(std::span<const Sweep> sweeps, std::span<const Measurement> rows);

}  // namespace brume::bench
