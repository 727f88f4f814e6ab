// SPDX-License-Identifier: Apache-2.0
#include <gpu/prefix_sum.hpp>

#include <shaders/gpu/scan.h>
#include <spv/gpu/scan_apply.comp.hpp>
#include <spv/gpu/scan_sums.comp.hpp>
#include <spv/gpu/scan_top.comp.hpp>

namespace brume::gpu {
namespace {

std::uint32_t chunkCount(std::uint32_t count) {
    return (count + shader::kScanChunk - 1) / shader::kScanChunk;
}

}  // namespace

PrefixSum::PrefixSum(Device& device)
    : mSums(device, {.name = "gpu.prefix_sum.sums",
                     .spirv = spv::gpu_scan_sums_comp,
                     .pushConstantBytes = sizeof(shader::ScanPush)}),
      mTop(device, {.name = "gpu.prefix_sum.top",
                    .spirv = spv::gpu_scan_top_comp,
                    .pushConstantBytes = sizeof(shader::ScanPush)}),
      mApply(device, {.name = "gpu.prefix_sum.apply",
                      .spirv = spv::gpu_scan_apply_comp,
                      .pushConstantBytes = sizeof(shader::ScanPush)}) {}

std::uint32_t PrefixSum::sumCount(std::uint32_t count) { return chunkCount(count) + 1; }

void PrefixSum::record(Commands& commands, VkDeviceAddress values, std::uint32_t count,
                       VkDeviceAddress sums) const {
    const shader::ScanPush push{values, sums, count};
    const std::uint32_t groups = (chunkCount(count) + 63) / 64;
    const ComputePipeline* const steps[] = {&mSums, &mTop, &mApply};
    for (const ComputePipeline* step : steps) {
        if (step != steps[0]) commands.computeBarrier();
        commands.bindCompute(*step);
        commands.pushConstants(push);
        commands.dispatch(step == &mTop ? 1 : groups);
    }
}

}  // namespace brume::gpu
