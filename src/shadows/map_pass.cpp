// SPDX-License-Identifier: Apache-2.0
#include <shadows/map_pass.hpp>

#include <shaders/common/frame_bindings.h>

namespace brume::shadows {

using frame::Access;

gpu::ComputePipeline makeMapPipeline(gpu::Device& device, const std::string& name,
                                     std::span<const std::uint32_t> spirv,
                                     std::vector<std::uint32_t> specialization,
                                     std::uint32_t pushConstantBytes,
                                     std::vector<gpu::NumberedConstant> constants) {
    return {device,
            {.name = name,
             .spirv = spirv,
             .bindings = {{shader::kBindingFrame, gpu::BindingType::StorageBuffer},
                          {shader::kBindingLights, gpu::BindingType::StorageBuffer},
                          {shader::kBindingMedia, gpu::BindingType::StorageBuffer}},
             .pushConstantBytes = pushConstantBytes,
             .specialization = std::move(specialization),
             .constants = std::move(constants)}};
}

void bindCasters(gpu::Commands& commands, const Casters& casters) {
    commands.bind(shader::kBindingFrame, *casters.frame);
    commands.bind(shader::kBindingLights, *casters.lights);
    commands.bind(shader::kBindingMedia, *casters.media);
}

std::uint64_t texelCount(const shader::ShadowMap& map) {
    return std::uint64_t{map.faceCount} * map.resolution * map.resolution;
}

void declareTexels(frame::FrameBuilder& frame, const std::string& name, const MapBuild& build,
                   const gpu::ComputePipeline& pipeline, const gpu::Buffer& target) {
    frame::PassBuilder& pass = frame.addPass(name);
    build.bins->declareReads(frame, pass);
    pass.reads(build.spheres, Access::ComputeRead);
    pass.reads(frame.importBuffer(*build.mapBuffer), Access::ComputeRead);
    pass.writes(frame.importBuffer(target), Access::ComputeWrite);
    pass.record([build, &pipeline, &target](gpu::Commands& commands, const frame::PassResources&) {
        commands.bindCompute(pipeline);
        bindCasters(commands, *build.casters);
        commands.pushConstants(shader::ShadowPush{.map = build.mapBuffer->deviceAddress(),
                                                  .target = target.deviceAddress()});
        commands.dispatchThreads(texelCount(*build.map), 64);
    });
}

}  // namespace brume::shadows
