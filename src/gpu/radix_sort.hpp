// SPDX-License-Identifier: Apache-2.0
// Stable sort of uint32 keys with uint32 values.
#pragma once

#include <gpu/prefix_sum.hpp>

namespace brume::gpu {

/// Least significant digit first, 8 bits at a time; each invocation takes a chunk in sequence, so
/// that neither shared memory nor a subgroup size is assumed. Owns its scratch memory:
/// 8 bytes per element and 4 per chunk and digit.
class RadixSort {
  public:
    RadixSort(Device& device, const std::string& name, std::uint32_t capacity);

    /// Sorts `count` <= capacity pairs in place, ascending by key. Records only; barriers between
    /// its own steps included, none before or after.
    void record(Commands& commands, VkDeviceAddress keys, VkDeviceAddress values,
                std::uint32_t count) const;

    std::uint64_t bytes() const;

  private:
    PrefixSum mPrefixSum;
    ComputePipeline mCount, mScatter;
    Buffer mKeys, mValues, mCounts, mSums;
};

}  // namespace brume::gpu
