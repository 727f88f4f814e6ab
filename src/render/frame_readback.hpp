// SPDX-License-Identifier: Apache-2.0
// What a frame is read back into: its image, and on request which triangles each pixel saw.
#pragma once

#include <core/image.hpp>
#include <frame/frame_builder.hpp>
#include <gpu/buffer.hpp>
#include <oit/oit_method.hpp>
#include <render/gpu_scene.hpp>
#include <render/opaque_pass.hpp>

#include <cstdint>
#include <vector>

namespace brume::render {

class FrameReadback {
  public:
    /// `withTriangles`: also the triangle hashes, which take a pass of their own.
    explicit FrameReadback(bool withTriangles) : mWithTriangles(withTriangles) {}

    /// Makes room for images of the scene's size and reads `inputs.result` back.
    void declare(frame::FrameBuilder& frame, gpu::Device& device, const GpuScene& scene,
                 OpaquePass& opaque, const oit::Inputs& inputs);

    /// Of a frame that has passed: means of `supersample` x `supersample` samples.
    Image readImage(int supersample) const;
    /// Sums of them, see Result::triangles; empty unless asked for.
    std::vector<std::uint32_t> readTriangles(int supersample) const;

  private:
    void makeRoom(gpu::Device& device, VkExtent2D extent);

    bool mWithTriangles;
    VkExtent2D mExtent{};
    gpu::Buffer mImage, mTriangles, mTrianglesRead;
};

}  // namespace brume::render
