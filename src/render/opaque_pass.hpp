// SPDX-License-Identifier: Apache-2.0
// What lies behind everything: background and opaque meshes, as a host's renderer would supply
// them.
#pragma once

#include <render/gpu_scene.hpp>

namespace brume::render {

class OpaquePass {
  public:
    OpaquePass(gpu::Device& device, const oit::Needs& needs);

    /// Passes "render.background" and "render.opaque"; sets inputs.opaqueColor, and
    /// inputs.opaqueT if that is not given.
    void declare(frame::FrameBuilder& frame, const GpuScene& scene, oit::Inputs& inputs) const;

    /// Pass "render.opaque" alone, over what inputs.opaqueT and inputs.opaqueColor already show;
    /// `depth` (D32) holds its reversed depth, or nothing yet. None without opaque meshes.
    void declareMeshes(frame::FrameBuilder& frame, const GpuScene& scene,
                       const oit::Inputs& inputs, frame::ImageRef depth, gpu::LoadOp load) const;

    /// Pass "render.triangles": per pixel the wrapping sum of triangleHash() of what it sees.
    void declareTriangles(frame::FrameBuilder& frame, const GpuScene& scene,
                          const oit::Inputs& inputs, const gpu::Buffer& triangles) const;

  private:
    gpu::GraphicsPipeline mBackground, mOpaque, mTriangles;
};

}  // namespace brume::render
