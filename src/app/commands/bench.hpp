// SPDX-License-Identifier: Apache-2.0
// `brume bench`: time, bytes and error of methods on scenes, in one table.
#pragma once

#include <app/session.hpp>
#include <bench/suites/suite.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace brume::app {

struct BenchArguments {
    std::vector<std::string> scenes;  ///< names, demos or files; empty: what fits the question
    std::vector<std::string> methods = {"all"};
    std::vector<std::string> shadows;  ///< measure these at points, instead of methods
    std::vector<std::string> suites;   ///< of bench::listSuites(), or all
    bool isQuick = false;              ///< suites at their small scale
    std::string shadow;                ///< store of all lights; empty: the scenes' own
    std::string truth;                 ///< scene that errors are against; empty: each its own
    std::string size;                  ///< "WxH"; empty: the scenes' own
    int repeats = 0;  ///< 0: 20, or fewer for quick suites
    std::uint32_t points = 2000;         ///< of --shadows
    std::uint32_t particles = 1'000'000;  ///< of --scenes simulate
    bool withError = true;
    int errorEvery = 1;
    std::vector<std::string> settings;  ///< "key=value"
    std::filesystem::path json;
    std::filesystem::path report;  ///< folder for table and images; empty: none
    std::vector<std::filesystem::path> compare;  ///< two results: say what changed, measure nothing
    double threshold = 0.25;                     ///< share of growth that is a regression
    bool onGpu = false;                          ///< refuse to measure a processor
    std::string command;                         ///< as it was given, for a shell
    DeviceArguments device;
};

/// What a run without suites measures. Throws an input Error.
std::vector<bench::Plan> makePlans(const BenchArguments& arguments);

/// Throws an input Error that names what else there is, if the device is a processor: software devices
/// measure something else.
void requireGpu(const gpu::DeviceInfo& device);

void runBench(const BenchArguments& arguments, const Log& log);

}  // namespace brume::app
