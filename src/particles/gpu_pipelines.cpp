// SPDX-License-Identifier: Apache-2.0
// The pipelines of a population, compiled for the modules that its effect uses.
#include <particles/gpu_population.hpp>
#include <spv/particles/appearance.comp.hpp>
#include <spv/particles/child_batches.comp.hpp>
#include <spv/particles/child_offsets.comp.hpp>
#include <spv/particles/collide_depth.comp.hpp>
#include <spv/particles/count.comp.hpp>
#include <spv/particles/offsets.comp.hpp>
#include <spv/particles/step.comp.hpp>
#include <spv/particles/totals.comp.hpp>

namespace brume::particles {

std::vector<std::uint32_t> GpuPopulation::specialization() const {
    std::vector<std::uint32_t> values(36, 0);
    values[0] = mWorkgroupSize;
#define BRUME_SPECIALIZE(Type, member, constant) \
    values[constant] = mEffect.parameters.member##Count;
    BRUME_MODULE_TYPES(BRUME_SPECIALIZE)
#undef BRUME_SPECIALIZE
    values[32] = mEffect.subEmitterCount;
    values[33] = mEffect.hasStrands;
    values[34] = mEffect.isWorldSpace();
    values[35] = mEffect.parameters.appearance.thinningDistance > 0;
    return values;
}

void GpuPopulation::makePipelines(gpu::Device& device) {
    using namespace shader;
    const auto make = [&](const char* name, std::span<const std::uint32_t> spirv,
                          std::initializer_list<std::uint32_t> bindings, std::size_t pushBytes) {
        gpu::ComputePipelineDesc desc;
        desc.name = name;
        desc.spirv = spirv;
        for (const std::uint32_t number : bindings) {
            const bool isState = number == kBindingState || number == kBindingNewState;
            for (std::uint32_t word = 0; word < (isState ? kStateWords : 1); ++word)
                desc.bindings.push_back({.number = number + word});
        }
        desc.pushConstantBytes = static_cast<std::uint32_t>(pushBytes);
        desc.specialization = specialization();
        return gpu::ComputePipeline(device, desc);
    };
    constexpr std::size_t kTickBytes = sizeof(TickPush), kChildBytes = sizeof(ChildPush);
    mCount = make("particles.count", spv::particles_count_comp,
                  {kBindingEffect, kBindingState, kBindingChunks, kBindingTotals, kBindingEmitters,
                   kBindingBatches, kBindingTicks, kBindingInstances, kBindingTriangles,
                   kBindingFieldValues},
                  kTickBytes);
    mOffsets = make("particles.offsets", spv::particles_offsets_comp,
                    {kBindingChunks, kBindingGroups, kBindingTicks}, kTickBytes);
    mTotalsPass = make("particles.totals", spv::particles_totals_comp,
                       {kBindingGroups, kBindingTotals, kBindingTicks}, kTickBytes);
    mStep = make("particles.step", spv::particles_step_comp,
                 {kBindingEffect, kBindingState, kBindingNewState, kBindingChunks, kBindingGroups,
                  kBindingTotals, kBindingEmitters, kBindingBatches, kBindingTicks,
                  kBindingInstances, kBindingTriangles, kBindingRecords, kBindingRecordCounts,
                  kBindingFieldValues, kBindingStrands, kBindingNewStrands, kBindingInstanceTicks,
                  kBindingInstanceNoise},
                 kTickBytes);
    mAppearance = make("particles.appearance", spv::particles_appearance_comp,
                       {kBindingEffect, kBindingState, kBindingTotals, kBindingParticleSpheres,
                        kBindingFieldValues, kBindingAppearance, kBindingInstances},
                       0);
    if (mEffect.depthCollider) {
        gpu::ComputePipelineDesc desc;
        desc.name = "particles.collide_depth";
        desc.spirv = spv::particles_collide_depth_comp;
        for (std::uint32_t word = 0; word < kStateWords; ++word)
            desc.bindings.push_back({.number = kBindingState + word});
        desc.bindings.push_back({.number = kBindingTotals});
        desc.bindings.push_back({.number = kBindingDepthCollider});
        desc.bindings.push_back(
            {.number = kBindingSceneDepth, .type = gpu::BindingType::SampledImage});
        desc.specialization = {mWorkgroupSize};
        mCollideDepth = gpu::ComputePipeline(device, desc);
    }
    if (mEffect.subEmitterCount == 0) return;
    mChildOffsets = make("particles.child_offsets", spv::particles_child_offsets_comp,
                         {kBindingTicks, kBindingRecordCounts, kBindingChildTotals}, kChildBytes);
    mChildBatches = make("particles.child_batches", spv::particles_child_batches_comp,
                         {kBindingTicks, kBindingRecords, kBindingRecordCounts,
                          kBindingChildTotals, kBindingChildBatches},
                         kChildBytes);
}

}  // namespace brume::particles
