// SPDX-License-Identifier: Apache-2.0
#include <render/frame_readback.hpp>

namespace brume::render {

void FrameReadback::makeRoom(gpu::Device& device, VkExtent2D extent) {
    mExtent = extent;
    const std::uint64_t pixels = std::uint64_t{extent.width} * extent.height;
    if (mImage.bytes() == 16 * pixels) return;
    mImage = gpu::Buffer(device, {.name = "render.image_read",
                                  .bytes = 16 * pixels,
                                  .memory = gpu::MemoryKind::Readback});
    if (!mWithTriangles) return;
    mTriangles = gpu::Buffer(device, {.name = "render.triangles", .bytes = 4 * pixels});
    mTrianglesRead = gpu::Buffer(device, {.name = "render.triangles_read",
                                          .bytes = 4 * pixels,
                                          .memory = gpu::MemoryKind::Readback});
}

void FrameReadback::declare(frame::FrameBuilder& frame, gpu::Device& device, const GpuScene& scene,
                            OpaquePass& opaque, const oit::Inputs& inputs) {
    makeRoom(device, scene.extent());
    if (mWithTriangles) {
        opaque.declareTriangles(frame, scene, inputs, mTriangles);
        frame.addReadback("render.triangles_read", frame.importBuffer(mTriangles), mTrianglesRead);
    }
    frame.addReadback("render.image_read", inputs.result, mImage);
}

Image FrameReadback::readImage(int supersample) const {
    const auto texels = mImage.mappedAs<vec4>();
    Image samples(static_cast<int>(mExtent.width), static_cast<int>(mExtent.height));
    for (std::size_t i = 0; i < samples.pixels.size(); ++i) samples.pixels[i] = vec3(texels[i]);
    return supersample > 1 ? downsample(samples, supersample) : samples;
}

std::vector<std::uint32_t> FrameReadback::readTriangles(int supersample) const {
    if (!mWithTriangles) return {};
    const std::size_t n = static_cast<std::size_t>(supersample), width = mExtent.width / n;
    const auto samples = mTrianglesRead.mappedAs<std::uint32_t>();
    std::vector<std::uint32_t> sums(width * (mExtent.height / n));
    for (std::size_t y = 0; y < mExtent.height; ++y)
        for (std::size_t x = 0; x < mExtent.width; ++x)
            sums[y / n * width + x / n] += samples[y * mExtent.width + x];
    return sums;
}

}  // namespace brume::render
