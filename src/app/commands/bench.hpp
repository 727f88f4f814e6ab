// SPDX-License-Identifier: Apache-2.0
// `brume bench`: time, bytes and error of methods on scenes, in one table.
#pragma once

#include <app/session.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace brume::app {

struct BenchArguments {
    std::vector<std::string> scenes;  ///< names, demos or files; empty: what fits the question
    std::vector<std::string> methods = {"all"};
    std::vector<std::string> shadows;  ///< measure these at points, instead of methods
    std::string size;                  ///< "WxH"; empty: the scenes' own
    int repeats = 20;
    bool withError = true;
    std::vector<std::string> settings;  ///< "key=value"
    std::filesystem::path json;
    std::filesystem::path report;  ///< folder for table and images; empty: none
    DeviceArguments device;
};

void runBench(const BenchArguments& arguments, const Log& log);

}  // namespace brume::app
