// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <app/sequence.hpp>
#include <charconv>
#include <core/error.hpp>
#include <optional>
#include <utility>

namespace brume::app {
namespace {

constexpr int kMaxShards = 100'000;

/// Two integers with `separator` between them and nothing else.
std::optional<std::pair<int, int>> parsePair(const std::string& text, char separator) {
    std::pair<int, int> pair;
    const char* end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, pair.first);
    if (first.ec != std::errc() || first.ptr == end || *first.ptr != separator) return std::nullopt;
    const auto second = std::from_chars(first.ptr + 1, end, pair.second);
    if (second.ec != std::errc() || second.ptr != end) return std::nullopt;
    return pair;
}

}  // namespace

FrameRange parseFrames(const std::string& text) {
    const auto pair = parsePair(text, ':');
    if (!pair || pair->first < 0 || pair->second < pair->first || pair->second > kMaxFrame)
        throw inputError("reading options", "--frames " + text,
                         fmt::format("not FIRST:LAST with 0 <= FIRST <= LAST <= {}", kMaxFrame));
    return {pair->first, pair->second};
}

Shard parseShard(const std::string& text) {
    if (text.empty()) return {};
    const auto pair = parsePair(text, '/');
    if (!pair || pair->second < 1 || pair->second > kMaxShards || pair->first < 0 ||
        pair->first > pair->second)
        throw inputError("reading options", "--shard " + text,
                         fmt::format("not I/N with 0 <= I <= N and 1 <= N <= {}", kMaxShards));
    return {pair->first, pair->second};
}

FrameRange framesOf(const FrameRange& all, const Shard& shard) {
    const auto begin = [&](int index) {
        return all.first +
               static_cast<int>(static_cast<long long>(all.count()) * index / shard.count);
    };
    if (shard.index == 0) return {all.first, all.first - 1};
    return {begin(shard.index - 1), begin(shard.index) - 1};
}

std::vector<int> firstFramesOf(const FrameRange& all, int shardCount) {
    std::vector<int> frames;
    for (int index = 1; index <= shardCount; ++index) {
        const FrameRange part = framesOf(all, {index, shardCount});
        if (part.count() > 0) frames.push_back(part.first);
    }
    return frames;
}

}  // namespace brume::app
