// SPDX-License-Identifier: Apache-2.0
// The images that hold what lies behind everything, whoever fills them.
#pragma once

#include <oit/inputs.hpp>

namespace brume::render {

inline constexpr VkFormat kColorFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
inline constexpr VkFormat kDistanceFormat = VK_FORMAT_R32_SFLOAT;
inline constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

/// Creates inputs.opaqueColor, and inputs.opaqueT if that is not given.
void createOpaqueTargets(frame::FrameBuilder& frame, oit::Inputs& inputs);

/// The reversed depth beside them.
frame::ImageRef createOpaqueDepth(frame::FrameBuilder& frame, const oit::Inputs& inputs);

}  // namespace brume::render
