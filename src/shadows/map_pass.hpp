// SPDX-License-Identifier: Apache-2.0
// Passes that visit the texels of a map: what all stores share.
#pragma once

#include <shadows/shadow_store.hpp>

namespace brume::shadows {

/// A pipeline that includes shaders/shadows/common/casters.glsl.
gpu::ComputePipeline makeMapPipeline(gpu::Device& device, const std::string& name,
                                     std::span<const std::uint32_t> spirv,
                                     std::vector<std::uint32_t> specialization = {},
                                     std::uint32_t pushConstantBytes = sizeof(shader::ShadowPush),
                                     std::vector<gpu::NumberedConstant> constants = {});

/// Binds FrameData, lights and media.
void bindCasters(gpu::Commands& commands, const Casters& casters);

/// One invocation per texel, a tile to a group; writes `target`.
void declareTexels(frame::FrameBuilder& frame, const std::string& name, const MapBuild& build,
                   const gpu::ComputePipeline& pipeline, const gpu::Buffer& target);

std::uint64_t texelCount(const shader::ShadowMap& map);

}  // namespace brume::shadows
