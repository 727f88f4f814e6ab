// SPDX-License-Identifier: Apache-2.0
// The map of total transmittance: a store of its own, and what corrects the stochastic one.
#pragma once

#include <shadows/shadow_store.hpp>

namespace brume::shadows {

class TotalMap {
  public:
    explicit TotalMap(gpu::Device& device);
    void allocate(shader::ShadowMap& map);
    /// Pass "shadow.total.build".
    void declare(frame::FrameBuilder& frame, const MapBuild& build) const;
    std::uint64_t bytes() const { return mTotals.bytes(); }

  private:
    gpu::Device* mDevice;
    gpu::ComputePipeline mBuild;
    gpu::Buffer mTotals;
};

}  // namespace brume::shadows
