// SPDX-License-Identifier: Apache-2.0
// The map of stochastic depths: a store of its own, and what variance maps are made of.
#pragma once

#include <shadows/shadow_store.hpp>

namespace brume::shadows {

struct StochasticSettings {
    std::uint32_t samples = 1;       ///< per texel, 1 .. 8
    bool isIndependent = false;      ///< samples of a texel are not stratified
    std::uint32_t filterRadius = 7;  ///< texels
};

/// Reads "samples", "mask" and "filter".
StochasticSettings readStochasticSettings(scene::SettingsReader& reader);
std::vector<scene::SettingInfo> listStochasticSettings();

class StochasticMap {
  public:
    StochasticMap(gpu::Device& device, const StochasticSettings& settings);
    void allocate(shader::ShadowMap& map);
    /// Pass "shadow.stochastic.build".
    void declare(frame::FrameBuilder& frame, const MapBuild& build) const;
    const gpu::Buffer& depths() const { return mDepths; }
    std::uint64_t bytes() const { return mDepths.bytes() + mNoise.bytes(); }

  private:
    gpu::Device* mDevice;
    StochasticSettings mSettings;
    gpu::ComputePipeline mBuild;
    gpu::Buffer mDepths, mNoise;
};

}  // namespace brume::shadows
