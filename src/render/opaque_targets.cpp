// SPDX-License-Identifier: Apache-2.0
#include <render/opaque_targets.hpp>

namespace brume::render {
namespace {

frame::ImageRef createTarget(frame::FrameBuilder& frame, const oit::Inputs& inputs,
                             const char* name, VkFormat format) {
    return frame.createImage({.name = name,
                              .format = format,
                              .width = inputs.extent.width,
                              .height = inputs.extent.height,
                              .usage = 0});
}

}  // namespace

void createOpaqueTargets(frame::FrameBuilder& frame, oit::Inputs& inputs) {
    inputs.opaqueColor = createTarget(frame, inputs, "render.opaque_color", kColorFormat);
    if (!inputs.opaqueT)
        inputs.opaqueT = createTarget(frame, inputs, "render.opaque_t", kDistanceFormat);
}

frame::ImageRef createOpaqueDepth(frame::FrameBuilder& frame, const oit::Inputs& inputs) {
    return createTarget(frame, inputs, "render.depth", kDepthFormat);
}

}  // namespace brume::render
