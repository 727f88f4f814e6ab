// SPDX-License-Identifier: Apache-2.0
// Which frames of a sequence a process renders.
#pragma once

#include <string>
#include <vector>

namespace brume::app {

inline constexpr int kMaxFrame = 1'000'000;

/// Frames [first, last].
struct FrameRange {
    int first = 0;
    int last = 0;
    int count() const { return last - first + 1; }
};

/// "FIRST:LAST". Throws an input Error.
FrameRange parseFrames(const std::string& text);

/// Part `index` (from 1) of `count`; index 0: no frames, but the checkpoints that the parts start
/// from.
struct Shard {
    int index = 1;
    int count = 1;
};

/// "I/N" with 0 <= I <= N; empty: all in one. Throws an input Error.
Shard parseShard(const std::string& text);

/// The consecutive frames of a part, which differ in number by at most one; count() may be 0.
FrameRange framesOf(const FrameRange& all, const Shard& shard);

/// The first frames of all parts that have any.
std::vector<int> firstFramesOf(const FrameRange& all, int shardCount);

}  // namespace brume::app
