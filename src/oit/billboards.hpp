// SPDX-License-Identifier: Apache-2.0
// Media and surfaces drawn one over the other: the part that `unordered` and `sorted` share.
#pragma once

#include <gpu/pipeline.hpp>
#include <oit/inputs.hpp>

#include <functional>
#include <string>

namespace brume::oit {

class Billboards {
  public:
    /// `name`: of the method; passes are "oit.<name>.clear" and "oit.<name>.store".
    Billboards(gpu::Device& device, const std::string& name, const Inputs& inputs);

    /// `order`: uint[spheres + boxes] as written by an earlier pass, or empty for the order of
    /// submission.
    void declare(frame::FrameBuilder& frame, const Inputs& inputs, frame::BufferRef order) const;

  private:
    void recordMedia(gpu::Commands& commands, const frame::PassResources& resources,
                     const Inputs& inputs, frame::BufferRef order) const;
    void recordSurfaces(gpu::Commands& commands, const frame::PassResources& resources,
                        const Inputs& inputs) const;

    std::string mName;
    gpu::GraphicsPipeline mMedia, mSurfaces;
};

}  // namespace brume::oit
