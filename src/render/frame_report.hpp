// SPDX-License-Identifier: Apache-2.0
// What a frame has cost, pass by pass and byte by byte.
#pragma once

#include <frame/frame_builder.hpp>
#include <gpu/timer_pool.hpp>
#include <render/renderer.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace brume::render {

/// One entry per pass name, in the order of their first times, with the bytes that they declare.
std::vector<PassTime> collectPasses(const frame::FrameBuilder& frame,
                                    const std::vector<gpu::ScopeTime>& times);

/// Of the frame proper: neither the comparison's pass nor what takes the image away.
double sumFrameMs(const std::vector<PassTime>& passes);

/// Of methods that bin media to tiles: what they hold for each pixel beside the image, and for each
/// pair of tile and medium. Empty for the others.
std::string describeMethodBytes(const frame::FrameDescription& frame,
                                const std::map<std::string, std::uint64_t>& bytes,
                                const std::map<std::string, std::uint64_t>& counters,
                                std::uint64_t pixelCount);

}  // namespace brume::render
