// SPDX-License-Identifier: Apache-2.0
// Exclusive prefix sum over a buffer of uint32.
#pragma once

#include <gpu/buffer.hpp>
#include <gpu/commands.hpp>
#include <gpu/pipeline.hpp>

namespace brume::gpu {

/// Sums in place. Records only; barriers between its own steps included, none before or after.
class PrefixSum {
  public:
    explicit PrefixSum(Device& device);

    /// Elements of `sums` that record() needs for `count` values; the total of all values is left
    /// at index totalIndex(count).
    static std::uint32_t sumCount(std::uint32_t count);
    static std::uint32_t totalIndex(std::uint32_t count) { return sumCount(count) - 1; }

    /// `values`: address of uint[count]; each becomes the sum (mod 2^32) of those before it.
    void record(Commands& commands, VkDeviceAddress values, std::uint32_t count,
                VkDeviceAddress sums) const;

  private:
    ComputePipeline mSums, mTop, mApply;
};

}  // namespace brume::gpu
