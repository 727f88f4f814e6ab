// SPDX-License-Identifier: Apache-2.0
#include <core/assert.hpp>
#include <particles/gpu_bounds.hpp>
#include <spv/particles/bounds.comp.hpp>

namespace brume::particles {
namespace {

constexpr std::uint32_t kWorkgroupSize = 64;

}  // namespace

GpuBounds::GpuBounds(gpu::Device& device, std::size_t rangeCount)
    : mRangeCount(rangeCount),
      mRangeData(device, {.name = "particles.bounds_ranges",
                          .bytes = sizeof(shader::BoundedFrame) +
                                   (rangeCount + 1) * sizeof(shader::BoundedRange)}),
      mWords(device, {.name = "particles.bounds",
                      .bytes = std::max<std::size_t>(rangeCount, 1) * 6 * sizeof(std::uint32_t)}),
      mPipeline(device, {.name = "particles.bounds",
                         .spirv = spv::particles_bounds_comp,
                         .bindings = {{.number = shader::kBindingBoundedSpheres},
                                      {.number = shader::kBindingBoundedRanges},
                                      {.number = shader::kBindingBounds}},
                         .specialization = {kWorkgroupSize}}) {
    mRanges.reserve(rangeCount);
}

void GpuBounds::record(gpu::Commands& commands, const gpu::Buffer& spheres,
                       std::span<const SphereRange> ranges) {
    BRUME_ASSERT_EQ(ranges.size(), mRangeCount);
    mRanges.clear();
    shader::BoundedFrame frame{static_cast<std::uint32_t>(ranges.size()), 0};
    for (const SphereRange& range : ranges) {
        mRanges.push_back({range.first, range.count, frame.chunks});
        frame.chunks += (range.count + shader::kBoundsChunk - 1) / shader::kBoundsChunk;
    }
    commands.beginLabel("particles.bounds");
    // Whatever has read or written these before is done with them.
    commands.computeTransferBarrier();
    commands.fillBuffer(mWords, shader::kBoundsEmpty);
    commands.updateArray<shader::BoundedFrame>(mRangeData, {&frame, 1});
    commands.updateArray<shader::BoundedRange>(mRangeData, mRanges, sizeof frame);
    commands.computeTransferBarrier();
    if (frame.chunks > 0) {
        commands.bindCompute(mPipeline);
        commands.bind(shader::kBindingBoundedSpheres, spheres);
        commands.bind(shader::kBindingBoundedRanges, mRangeData);
        commands.bind(shader::kBindingBounds, mWords);
        commands.dispatchThreads(frame.chunks, kWorkgroupSize);
        commands.computeTransferBarrier();
    }
    commands.endLabel();
}

std::uint64_t GpuBounds::bytes() const { return mRangeData.bytes() + mWords.bytes(); }

std::vector<Box3> GpuBounds::makeBoxes(std::span<const std::uint32_t> words,
                                       const dvec3& origin) {
    std::vector<Box3> boxes(words.size() / 6);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const std::span<const std::uint32_t> w = words.subspan(6 * i, 6);
        if (w[0] == shader::kBoundsEmpty) continue;
        for (int axis = 0; axis < 3; ++axis) {
            boxes[i].lo[axis] = origin[axis] + double{shader::fromOrderedKey(w[axis])};
            boxes[i].hi[axis] = origin[axis] + double{shader::fromOrderedKey(~w[3 + axis])};
        }
    }
    return boxes;
}

}  // namespace brume::particles
