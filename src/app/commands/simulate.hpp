// SPDX-License-Identifier: Apache-2.0
// `brume simulate`: runs an effect without rendering it.
#pragma once

#include <app/session.hpp>
#include <cstdint>
#include <filesystem>

namespace brume::app {

struct SimulateArguments {
    std::filesystem::path effect;
    int frames = 24;
    double secondsPerFrame = 1.0 / 24;  ///< s
    std::uint64_t seed = 0;
    bool hash = false;       ///< print the hash of the state
    bool reference = false;  ///< simulate on the CPU
    std::filesystem::path from;        ///< a checkpoint to go on from, or empty
    std::filesystem::path checkpoint;  ///< where to write the state, or empty
    std::filesystem::path json;
    DeviceArguments device;
};

void runSimulate(const SimulateArguments& arguments, const Log& log);

}  // namespace brume::app
