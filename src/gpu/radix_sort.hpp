// SPDX-License-Identifier: Apache-2.0
// Stable sort of uint32 keys with uint32 values.
#pragma once

#include <gpu/prefix_sum.hpp>

namespace brume::gpu {

/// Least significant digit first, 8 bits at a time; each invocation takes a chunk in sequence, so
/// that neither shared memory nor a subgroup size is assumed. Owns its scratch memory: 16 bytes per
/// element, and 4 per chunk and digit.
class RadixSort {
  public:
    /// Arrays of more than `maxBoundBytes`, or than a device binds, are reached by their addresses,
    /// which is slower on software devices.
    RadixSort(Device& device, const std::string& name, std::uint32_t capacity,
              std::uint64_t maxBoundBytes = ~std::uint64_t{0});

    /// Sorts the first `count` <= capacity pairs in place, ascending by key. Records only; barriers
    /// between its own steps included, none before or after.
    void record(Commands& commands, const Buffer& keys, const Buffer& values,
                std::uint32_t count) const;

    std::uint64_t bytes() const;

  private:
    bool isByAddress() const;

    std::uint32_t mCapacity;
    std::uint64_t mMaxBoundBytes;
    PrefixSum mPrefixSum;
    ComputePipeline mCountKeys, mCountPairs;
    ComputePipeline mJoin, mMove, mSplit;  // scatter: keys and values to pairs, pairs, and back
    Buffer mPairs[2];
    Buffer mCounts, mSums;
};

}  // namespace brume::gpu
