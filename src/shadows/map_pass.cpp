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

namespace {

/// A pass that continues what earlier ones have left undone; `progress`: null where there is but one.
struct Round {
    const gpu::Buffer* progress = nullptr;
    std::uint32_t number = 0;
};

void declareRound(frame::FrameBuilder& frame, const std::string& name, const MapBuild& build,
                  const gpu::ComputePipeline& pipeline, const gpu::Buffer& target,
                  const Round& round) {
    frame::PassBuilder& pass = frame.addPass(name);
    build.bins->declareReads(frame, pass);
    pass.reads(build.spheres, Access::ComputeRead);
    pass.reads(frame.importBuffer(*build.mapBuffer), Access::ComputeRead);
    for (const gpu::Buffer* buffer : {&target, round.progress}) {
        if (!buffer) continue;
        if (round.number == 0)
            pass.writes(frame.importBuffer(*buffer), Access::ComputeWrite);
        else
            pass.readsWrites(frame.importBuffer(*buffer), Access::ComputeWrite);
    }
    pass.record([build, &pipeline, &target, round](gpu::Commands& commands,
                                                   const frame::PassResources&) {
        commands.bindCompute(pipeline);
        bindCasters(commands, *build.casters);
        commands.pushConstants(shader::ShadowPush{
            .map = build.mapBuffer->deviceAddress(),
            .target = target.deviceAddress(),
            .source = round.progress ? round.progress->deviceAddress() : 0,
            .count = round.number});
        commands.dispatchThreads(texelCount(*build.map), 64);
    });
}

}  // namespace

void declareTexels(frame::FrameBuilder& frame, const std::string& name, const MapBuild& build,
                   const gpu::ComputePipeline& pipeline, const gpu::Buffer& target) {
    declareRound(frame, name, build, pipeline, target, {});
}

void declareWalk(frame::FrameBuilder& frame, const std::string& name, const MapBuild& build,
                 const gpu::ComputePipeline& pipeline, const gpu::Buffer& target,
                 std::uint32_t turns) {
    // Pieces of a sphere (walk.glsl), and cells of a brick that a ray crosses at most.
    constexpr std::uint64_t kSpherePieces = 6, kBoxPieces = 22;
    const ListLengths longest = build.bins->longestLists();
    const std::uint64_t all = longest.spheres * (2 + kSpherePieces * (1 + turns)) +
                              longest.boxes * (2 + kBoxPieces * (1 + turns));
    const auto rounds = static_cast<std::uint32_t>(1 + all / shader::kTurnsPerRound);
    for (std::uint32_t round = 0; round < rounds; ++round)
        declareRound(frame, name, build, pipeline, target, {&build.bins->progress(), round});
}

}  // namespace brume::shadows
