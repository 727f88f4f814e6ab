// SPDX-License-Identifier: Apache-2.0
// The lights' shares on the spheres that are shadowed as a whole (scene::Shadowing::Particle).
#pragma once

#include <frame/frame_builder.hpp>
#include <gpu/pipeline.hpp>
#include <shadows/casters.hpp>

#include <cstdint>

namespace brume::shadows {

class SphereShares {
  public:
    /// `stores`: bits of kShadowStores of all lights. Room for each of the casters' spheres.
    SphereShares(gpu::Device& device, const Casters& casters, std::uint32_t lightCount,
                 std::uint32_t stores);

    /// Adds the pass "shadow.spheres"; maps are to be complete before it.
    void declare(frame::FrameBuilder& frame, frame::BufferRef spheres) const;

    /// Of what FrameData::lightShares says.
    VkDeviceAddress address() const { return mShares.deviceAddress(); }
    std::uint64_t bytes() const { return mShares.bytes(); }

  private:
    Casters mCasters;
    std::uint32_t mLightCount;
    gpu::ComputePipeline mPipeline;
    gpu::Buffer mShares;
};

}  // namespace brume::shadows
