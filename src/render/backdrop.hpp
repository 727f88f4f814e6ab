// SPDX-License-Identifier: Apache-2.0
// What a host has drawn, taken in as the opaque scene, and the result given back into it.
#pragma once

#include <oit/inputs.hpp>

#include <shaders/render/backdrop.h>

namespace brume::render {

class Backdrop {
  public:
    /// `colorFormat`: of the host's colour image.
    Backdrop(gpu::Device& device, VkFormat colorFormat);

    /// How depths are to be understood and where the viewport lies; for frames recorded after it.
    void setPush(const shader::BackdropPush& push) { mPush = push; }

    /// Pass "render.import": sets inputs.opaqueT and inputs.opaqueColor from the host's images.
    /// Returns the reversed depth (D32).
    frame::ImageRef declareImport(frame::FrameBuilder& frame, oit::Inputs& inputs,
                                  frame::ImageRef color, frame::ImageRef depth) const;
    /// Pass "render.composite": inputs.result into the viewport of the host's colour image; its
    /// alpha stays.
    void declareComposite(frame::FrameBuilder& frame, const oit::Inputs& inputs,
                          frame::ImageRef color) const;

  private:
    shader::BackdropPush mPush{};
    gpu::GraphicsPipeline mImport, mComposite;
};

}  // namespace brume::render
