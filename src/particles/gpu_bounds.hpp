// SPDX-License-Identifier: Apache-2.0
// Boxes around particles, found on the device: conservative, and read back whenever the caller likes.
#pragma once

#include <gpu/commands.hpp>
#include <gpu/submitter.hpp>

#include <shaders/particles/bounds.h>

#include <span>
#include <vector>

namespace brume::particles {

/// Spheres [first, first + count).
struct SphereRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// One dispatch for all ranges. 24 bytes per range.
class GpuBounds {
  public:
    GpuBounds(gpu::Device& device, std::size_t rangeCount);

    /// `ranges`: as many as the constructor was told. Spheres without a radius or a
    /// density do not count.
    void record(gpu::Commands& commands, const gpu::Buffer& spheres,
                std::span<const SphereRange> ranges);

    /// Six words for each range, for makeBoxes().
    const gpu::Buffer& words() const { return mWords; }
    std::uint64_t bytes() const;

    /// World boxes of the words; empty where no sphere is. `origin`: which the spheres' centres are
    /// relative to.
    static std::vector<Box3> makeBoxes(std::span<const std::uint32_t> words, const dvec3& origin);

  private:
    std::size_t mRangeCount;
    std::vector<shader::BoundedRange> mRanges;  // keeps its memory
    gpu::Buffer mRangeData, mWords;
    gpu::ComputePipeline mPipeline;
};

}  // namespace brume::particles
