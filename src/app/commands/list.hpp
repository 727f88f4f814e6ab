// SPDX-License-Identifier: Apache-2.0
// `brume list`: what there is to choose from.
#pragma once

#include <core/log.hpp>
#include <string>

namespace brume::app {

struct ListArguments {
    std::string what;       ///< methods, shadows, modules, devices or scenes
    bool markdown = false;  ///< methods only: the table of the README
};

void runList(const ListArguments& arguments, const Log& log);

}  // namespace brume::app
