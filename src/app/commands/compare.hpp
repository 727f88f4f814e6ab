// SPDX-License-Identifier: Apache-2.0
// `brume compare`: how far one image file is from another.
#pragma once

#include <core/log.hpp>
#include <filesystem>

namespace brume::app {

struct CompareArguments {
    std::filesystem::path test;
    std::filesystem::path reference;
    std::filesystem::path json;  ///< empty: none
    std::filesystem::path diff;  ///< picture of the absolute differences; empty: none
};

void runCompare(const CompareArguments& arguments, const Log& log);

}  // namespace brume::app
