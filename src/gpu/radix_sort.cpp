// SPDX-License-Identifier: Apache-2.0
#include <core/assert.hpp>
#include <gpu/radix_sort.hpp>

#include <shaders/gpu/scan.h>
#include <spv/gpu/sort_count.comp.hpp>
#include <spv/gpu/sort_scatter.comp.hpp>

#include <algorithm>

namespace brume::gpu {
namespace {

constexpr std::uint32_t kGroupSize = 32;
constexpr std::uint32_t kPasses = 4, kDigitBits = 8;
static_assert(shader::kSortDigits == 1u << kDigitBits);

/// Elements that one invocation handles in sequence: a few hundred chunks keep the device busy, and
/// longer ones write longer runs; measured on lavapipe. Few enough for devices that cap the loop
/// iterations of an invocation. Rounded up: one chunk more than wanted is a workgroup more than the
/// device's threads have between them.
constexpr std::uint32_t kMinChunk = 256, kMaxChunk = 2048, kWantedChunks = 512;

std::uint32_t chunkSizeOf(std::uint32_t count) {
    return std::clamp((count + kWantedChunks - 1) / kWantedChunks, kMinChunk, kMaxChunk);
}

std::uint32_t chunkCount(std::uint32_t count) {
    const std::uint32_t size = chunkSizeOf(count);
    return (count + size - 1) / size;
}

/// Chunks of any count up to the capacity: between the two sizes there are about kWantedChunks.
std::uint32_t maxChunkCount(std::uint32_t capacity) {
    return std::max(chunkCount(capacity), std::min(capacity / kMinChunk, kWantedChunks) + 4);
}

Buffer makeScratch(Device& device, const std::string& name, std::uint64_t elements,
                   std::uint64_t bytesEach) {
    return Buffer(device,
                  {.name = name, .bytes = std::max<std::uint64_t>(elements, 1) * bytesEach});
}

}  // namespace

RadixSort::RadixSort(Device& device, const std::string& name, std::uint32_t capacity,
                     std::uint64_t maxBoundBytes)
    : mCapacity(capacity),
      mMaxBoundBytes(std::min(maxBoundBytes, device.limits().maxStorageBufferRange)),
      mPrefixSum(device),
      mPairs{makeScratch(device, name + ".pairsA", capacity, 8),
             makeScratch(device, name + ".pairsB", capacity, 8)},
      mCounts(
          makeScratch(device, name + ".counts", maxChunkCount(capacity) * shader::kSortDigits, 4)),
      mSums(makeScratch(device, name + ".sums",
                        PrefixSum::sumCount(maxChunkCount(capacity) * shader::kSortDigits), 4)) {
    const auto make = [&](const char* pass, std::span<const std::uint32_t> spirv, bool readsPairs,
                          bool writesPairs) {
        return ComputePipeline(
            device,
            {.name = std::string("gpu.radix_sort.") + pass,
             .spirv = spirv,
             .bindings =
                 {{.number = 0}, {.number = 1}, {.number = 2}, {.number = 3}, {.number = 4}},
             .pushConstantBytes = sizeof(shader::SortPush),
             .specialization = {readsPairs, writesPairs, isByAddress()}});
    };
    mCountKeys = make("count_keys", spv::gpu_sort_count_comp, false, false);
    mCountPairs = make("count_pairs", spv::gpu_sort_count_comp, true, false);
    mJoin = make("join", spv::gpu_sort_scatter_comp, false, true);
    mMove = make("move", spv::gpu_sort_scatter_comp, true, true);
    mSplit = make("split", spv::gpu_sort_scatter_comp, true, false);
}

bool RadixSort::isByAddress() const { return mCapacity * std::uint64_t{8} > mMaxBoundBytes; }

void RadixSort::record(Commands& commands, const Buffer& keys, const Buffer& values,
                       std::uint32_t count) const {
    BRUME_ASSERT_LE(count, mCapacity);
    const std::uint32_t chunks = chunkCount(count);
    if (chunks == 0) return;
    for (std::uint32_t pass = 0; pass < kPasses; ++pass) {
        const bool isFirst = pass == 0, isLast = pass + 1 == kPasses;
        const Buffer &in = mPairs[(pass + 1) % 2], &out = mPairs[pass % 2];
        const shader::SortPush push{keys.deviceAddress(),
                                    values.deviceAddress(),
                                    in.deviceAddress(),
                                    out.deviceAddress(),
                                    count,
                                    chunkSizeOf(count),
                                    kDigitBits * pass};
        const auto run = [&](const ComputePipeline& pipeline) {
            commands.bindCompute(pipeline);
            const Buffer* const arrays[] = {&keys, &values, &in, &out};
            for (std::uint32_t i = 0; i < std::size(arrays); ++i)
                commands.bind(i, {arrays[i], 0, std::min(arrays[i]->bytes(), mMaxBoundBytes)});
            commands.bind(4, mCounts);
            commands.pushConstants(push);
            commands.dispatch((chunks + kGroupSize - 1) / kGroupSize);
        };
        if (!isFirst) commands.computeBarrier();
        run(isFirst ? mCountKeys : mCountPairs);
        commands.computeBarrier();
        mPrefixSum.record(commands, mCounts.deviceAddress(), chunks * shader::kSortDigits,
                          mSums.deviceAddress());
        commands.computeBarrier();
        run(isFirst ? mJoin : isLast ? mSplit : mMove);
    }
}

std::uint64_t RadixSort::bytes() const {
    return mPairs[0].bytes() + mPairs[1].bytes() + mCounts.bytes() + mSums.bytes();
}

}  // namespace brume::gpu
