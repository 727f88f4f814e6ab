// SPDX-License-Identifier: Apache-2.0
#include <gpu/upload.hpp>
#include <oit/bindings.hpp>
#include <render/shadow_probe.hpp>

#include <shaders/shadows/common/maps.h>
#include <spv/shadows/common/probe.comp.hpp>

namespace brume::render {

using frame::Access;

ShadowProbe::ShadowProbe(gpu::Submitter& submitter, const oit::Needs& needs, std::uint32_t light,
                         std::span<const vec3> positions)
    : mLight(light),
      mCount(static_cast<std::uint32_t>(positions.size())),
      mPipeline(submitter.device(), {.name = "shadow.probe",
                                     .spirv = spv::shadows_common_probe_comp,
                                     .bindings = oit::frameBindings(),
                                     .pushConstantBytes = sizeof(shader::ShadowPush),
                                     .constants = oit::lightingConstants(needs)}) {
    gpu::Device& device = submitter.device();
    const std::uint64_t bytes = positions.size_bytes();
    mResults = {device, {.name = "shadow.probe.results", .bytes = bytes}};
    mResultsRead = {
        device,
        {.name = "shadow.probe.results_read", .bytes = bytes, .memory = gpu::MemoryKind::Readback}};
    submitter.submitAndWait("upload probe", [&](gpu::Commands& commands) {
        mPositions = gpu::makeBuffer(commands, "shadow.probe.positions", positions);
    });
}

void ShadowProbe::declare(frame::FrameBuilder& frame, const oit::Inputs& inputs) const {
    frame.addPass("shadow.probe")
        .reads(frame.importBuffer(mPositions), Access::ComputeRead)
        .writes(frame.importBuffer(mResults), Access::ComputeWrite)
        .record([this, inputs](gpu::Commands& commands, const frame::PassResources&) {
            commands.bindCompute(mPipeline);
            oit::bindFrame(commands, inputs);
            commands.pushConstants(shader::ShadowPush{.map = mLight,
                                                      .target = mResults.deviceAddress(),
                                                      .source = mPositions.deviceAddress(),
                                                      .count = mCount});
            commands.dispatchThreads(mCount, 64);
        });
    frame.addReadback("shadow.probe_read", frame.importBuffer(mResults), mResultsRead);
}

std::vector<vec3> ShadowProbe::read() const {
    const auto values = mResultsRead.mappedAs<vec3>();
    return {values.begin(), values.end()};
}

}  // namespace brume::render
