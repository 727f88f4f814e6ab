// SPDX-License-Identifier: Apache-2.0
// Asks the shadow maps at given points: for tests and benchmarks.
#pragma once

#include <core/math.hpp>
#include <frame/frame_builder.hpp>
#include <gpu/submitter.hpp>
#include <oit/inputs.hpp>

#include <span>
#include <vector>

namespace brume::render {

class ShadowProbe {
  public:
    /// `positions`: relative to the camera.
    ShadowProbe(gpu::Submitter& submitter, const oit::Needs& needs, std::uint32_t light,
                std::span<const vec3> positions);

    /// Pass "shadow.probe"; after that frame, read() has the results.
    void declare(frame::FrameBuilder& frame, const oit::Inputs& inputs) const;
    std::vector<vec3> read() const;

  private:
    std::uint32_t mLight, mCount;
    gpu::ComputePipeline mPipeline;
    gpu::Buffer mPositions, mResults, mResultsRead;
};

}  // namespace brume::render
