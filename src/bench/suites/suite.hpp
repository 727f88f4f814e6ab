// SPDX-License-Identifier: Apache-2.0
// A suite is data: which scenes are measured with which methods, and how its rows are read. Each has
// a file in this folder and a line in suites.cpp.
#pragma once

#include <bench/results.hpp>
#include <scene/settings.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace brume::bench {

enum class PlanKind {
    Frames,        ///< methods on a scene
    ShadowPoints,  ///< shadow stores, asked at points of a scene
    Simulation     ///< ticks of the particle simulator
};

/// Some rows: one scene, several methods in turn.
struct Plan {
    PlanKind kind = PlanKind::Frames;
    std::string scene;
    std::vector<std::string> methods;  ///< "stochastic:samples=16"; shadow stores of ShadowPoints
    ivec2 size{0};                     ///< 0: the scene's own
    std::string shadow;                ///< store of all lights; empty: the scene's own
    scene::Settings settings;          ///< each method or store gets those it knows
    int repeats = 0;                   ///< 0: the run's
    bool withError = true;
    std::string truth = {};    ///< scene that errors are against; empty: the same
    bool isRival = false;     ///< Frames: measured in turn with the plan before it, round by round
    std::uint32_t count = 0;  ///< points of ShadowPoints, particles of Simulation; 0: the default
};

enum class Scale {
    Full,  ///< as published, or as large as the question needs
    Quick  ///< the same rows, small enough for a few minutes on two cores
};

struct Suite {
    std::string_view name;
    std::string_view summary;
    std::vector<Plan> (*plan)(Scale scale);
    /// What the rows of this suite say.
    Findings (*read)(std::span<const Measurement> rows, Scale scale);
};

std::span<const Suite> listSuites();
const Suite* findSuite(std::string_view name);

// For suites ------------------------------------------------------------------------------------

/// The row of a scene and method, as planned; null if there is none or it failed.
const Row* findRow(std::span<const Measurement> rows, std::string_view scene,
                   std::string_view method, ivec2 size = ivec2(0), std::string_view shadow = {});

/// Names of all methods: those of oit::listMethods(), `tile` also with epsilon = 0.
std::vector<std::string> listAllMethods();

/// Sum of the medians of the passes whose names begin with one of the words, separated by '|'.
double sumPasses(const Row& row, std::string_view beginnings);

/// "12.3", three figures.
std::string formatMs(double ms);
/// "1.2e-05"
std::string formatError(double error);

}  // namespace brume::bench
