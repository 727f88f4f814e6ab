// SPDX-License-Identifier: Apache-2.0
// `brume render`: images of a scene file, what they cost and how exact they are.
#pragma once

#include <app/session.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace brume::app {

/// Frames per second of --frame and --frames.
inline constexpr double kDefaultFrameRate = 24;

struct RenderArguments {
    std::filesystem::path scene;
    std::filesystem::path output;  ///< .exr or .png; may hold #### or %04d; empty: no file
    std::string method;            ///< empty: the scene's
    std::string shadow;            ///< for all lights; empty: the scene's
    std::string size;              ///< "WxH"; empty: the scene's
    std::optional<int> frame;  ///< effects at frame / frameRate seconds; none: at their own times
    std::string frames;        ///< "A:B", both included
    std::string shard;         ///< "I/N": the I-th of N parts of the frames; 0/N: their checkpoints
    std::filesystem::path checkpoints;  ///< folder of simulation states; empty: none
    bool resume = false;                ///< leave out frames whose files are there
    double frameRate = kDefaultFrameRate;
    std::optional<std::uint64_t> particleBudget;  ///< instead of the scene's
    std::optional<std::uint64_t> seed;  ///< of the first effect, counting up for the others
    std::vector<std::string> settings;  ///< "key=value"
    std::string against;                ///< "reference", an image file, or empty
    bool explain = false;
    int repeats = 1;  ///< frames measured; more than one: after one more to warm up
    std::filesystem::path json;
    DeviceArguments device;
};

void runRender(const RenderArguments& arguments, const Log& log);

}  // namespace brume::app
