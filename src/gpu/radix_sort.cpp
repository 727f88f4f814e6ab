// SPDX-License-Identifier: Apache-2.0
#include <core/assert.hpp>
#include <gpu/radix_sort.hpp>

#include <shaders/gpu/scan.h>
#include <spv/gpu/sort_count.comp.hpp>
#include <spv/gpu/sort_scatter.comp.hpp>

#include <algorithm>
#include <utility>

namespace brume::gpu {
namespace {

std::uint32_t chunkCount(std::uint32_t count) {
    return (count + shader::kSortChunk - 1) / shader::kSortChunk;
}

Buffer makeScratch(Device& device, const std::string& name, std::uint64_t elements) {
    return Buffer(device, {.name = name, .bytes = std::max<std::uint64_t>(elements, 1) * 4});
}

}  // namespace

RadixSort::RadixSort(Device& device, const std::string& name, std::uint32_t capacity)
    : mPrefixSum(device),
      mCount(device, {.name = "gpu.radix_sort.count",
                      .spirv = spv::gpu_sort_count_comp,
                      .pushConstantBytes = sizeof(shader::SortPush)}),
      mScatter(device, {.name = "gpu.radix_sort.scatter",
                        .spirv = spv::gpu_sort_scatter_comp,
                        .pushConstantBytes = sizeof(shader::SortPush)}),
      mKeys(makeScratch(device, name + ".keys", capacity)),
      mValues(makeScratch(device, name + ".values", capacity)),
      mCounts(makeScratch(device, name + ".counts", chunkCount(capacity) * shader::kSortDigits)),
      mSums(makeScratch(device, name + ".sums",
                        PrefixSum::sumCount(chunkCount(capacity) * shader::kSortDigits))) {}

void RadixSort::record(Commands& commands, VkDeviceAddress keys, VkDeviceAddress values,
                       std::uint32_t count) const {
    BRUME_ASSERT_LE(std::uint64_t{count} * 4, mKeys.bytes());
    const std::uint32_t chunks = chunkCount(count);
    if (chunks == 0) return;
    shader::SortPush push{
        keys,  values, mKeys.deviceAddress(), mValues.deviceAddress(), mCounts.deviceAddress(),
        count, 0};
    constexpr std::uint32_t kPasses = 4;  // even: the result is where it came from
    for (std::uint32_t pass = 0; pass < kPasses; ++pass) {
        push.shift = 8 * pass;
        if (pass > 0) commands.computeBarrier();
        commands.bindCompute(mCount);
        commands.pushConstants(push);
        commands.dispatch((chunks + 63) / 64);
        commands.computeBarrier();
        mPrefixSum.record(commands, mCounts.deviceAddress(), chunks * shader::kSortDigits,
                          mSums.deviceAddress());
        commands.computeBarrier();
        commands.bindCompute(mScatter);
        commands.pushConstants(push);
        commands.dispatch((chunks + 63) / 64);
        std::swap(push.keysIn, push.keysOut);
        std::swap(push.valuesIn, push.valuesOut);
    }
}

std::uint64_t RadixSort::bytes() const {
    return mKeys.bytes() + mValues.bytes() + mCounts.bytes() + mSums.bytes();
}

}  // namespace brume::gpu
