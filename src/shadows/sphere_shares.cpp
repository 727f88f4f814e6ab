// SPDX-License-Identifier: Apache-2.0
#include <shadows/map_pass.hpp>
#include <shadows/sphere_shares.hpp>

#include <spv/shadows/spheres/shares.comp.hpp>

namespace brume::shadows {

SphereShares::SphereShares(gpu::Device& device, const Casters& casters, std::uint32_t lightCount,
                           std::uint32_t stores)
    : mCasters(casters),
      mLightCount(lightCount),
      mPipeline(makeMapPipeline(device, "shadow.spheres", spv::shadows_spheres_shares_comp, {},
                                sizeof(shader::SharesPush),
                                {{shader::kConstantShadowStores, stores}})),
      mShares(device, {.name = "shadow.spheres.shares",
                       .bytes = sizeof(vec3) * casters.sphereCount * lightCount}) {}

void SphereShares::declare(frame::FrameBuilder& frame, frame::BufferRef spheres) const {
    frame.addPass("shadow.spheres")
        .reads(spheres, frame::Access::ComputeRead)
        .writes(frame.importBuffer(mShares), frame::Access::ComputeWrite)
        .record([this](gpu::Commands& commands, const frame::PassResources&) {
            commands.bindCompute(mPipeline);
            bindCasters(commands, mCasters);
            commands.pushConstants(
                shader::SharesPush{.spheres = mCasters.spheres->deviceAddress(),
                                   .shares = mShares.deviceAddress(),
                                   .count = mCasters.sphereCount});
            commands.dispatchThreads(std::uint64_t{mCasters.sphereCount} * mLightCount, 64);
        });
}

}  // namespace brume::shadows
