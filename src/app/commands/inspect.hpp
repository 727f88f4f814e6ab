// SPDX-License-Identifier: Apache-2.0
// `brume inspect`: what is in a volume, scene or effect file.
#pragma once

#include <core/log.hpp>
#include <filesystem>

namespace brume::app {

struct InspectArguments {
    std::filesystem::path file;
};

void runInspect(const InspectArguments& arguments, const Log& log);

}  // namespace brume::app
