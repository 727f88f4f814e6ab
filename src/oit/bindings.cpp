// SPDX-License-Identifier: Apache-2.0
#include <oit/bindings.hpp>

#include <shaders/common/frame.h>
#include <shaders/common/frame_bindings.h>
#include <shaders/common/mesh.h>
#include <shaders/shadows/common/maps.h>

namespace brume::oit {

using gpu::BindingType;

std::vector<gpu::Binding> frameBindings() {
    return {{shader::kBindingFrame, BindingType::StorageBuffer},
            {shader::kBindingLights, BindingType::StorageBuffer},
            {shader::kBindingMedia, BindingType::StorageBuffer}};
}

std::vector<gpu::Binding> mediaBindings() {
    return {{shader::kBindingSpheres, BindingType::StorageBuffer},
            {shader::kBindingBoxes, BindingType::StorageBuffer},
            {shader::kBindingVolumes, BindingType::StorageBuffer}};
}

std::vector<gpu::Binding> surfaceBindings() {
    return {{shader::kBindingFrame, BindingType::UniformBuffer},
            {shader::kBindingLights, BindingType::StorageBuffer},
            {shader::kBindingMedia, BindingType::StorageBuffer},
            {shader::kBindingFirstLights, BindingType::UniformBuffer},
            {shader::kBindingVertices, BindingType::StorageBuffer},
            {shader::kBindingIndices, BindingType::StorageBuffer},
            {shader::kBindingMesh, BindingType::UniformBuffer},
            {shader::kBindingMaterial, BindingType::UniformBuffer},
            {shader::kBindingColorTexture, BindingType::SampledImage},
            {shader::kBindingEmissionTexture, BindingType::SampledImage},
            {shader::kBindingEnvironment, BindingType::SampledImage}};
}

std::vector<gpu::Binding> join(std::vector<gpu::Binding> a, const std::vector<gpu::Binding>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

std::vector<gpu::NumberedConstant> lightingConstants(const Needs& needs) {
    return {{shader::kConstantShadowStores, needs.shadowStores},
            {shader::kConstantShadowing, needs.shadowing},
            {shader::kConstantGlossy, needs.glossy},
            {shader::kConstantLightCount, needs.lights},
            {shader::kConstantParallelRays, needs.orthographic},
            {shader::kConstantTextured, needs.textured},
            {shader::kConstantPointLights, needs.pointLights},
            {shader::kConstantOpaque, needs.opaque},
            {shader::kConstantSolids, needs.solids}};
}

std::span<const std::uint32_t> chooseReal(const gpu::Device& device,
                                          std::span<const std::uint32_t> float32,
                                          std::span<const std::uint32_t> float64) {
    return device.features().shaderFloat64 ? float64 : float32;
}

void bindFrame(gpu::Commands& commands, const Inputs& inputs) {
    commands.bind(shader::kBindingFrame, *inputs.frame);
    commands.bind(shader::kBindingLights, *inputs.lights);
    commands.bind(shader::kBindingMedia, *inputs.media);
}

void bindMedia(gpu::Commands& commands, const Inputs& inputs, const gpu::Buffer& spheres,
               const gpu::Buffer& boxes) {
    commands.bind(shader::kBindingSpheres, spheres);
    commands.bind(shader::kBindingBoxes, boxes);
    commands.bind(shader::kBindingVolumes, *inputs.volumes);
}

void bindMeshes(gpu::Commands& commands, const Inputs& inputs) {
    commands.bind(shader::kBindingFirstLights,
                  gpu::BufferRange{inputs.lights, 0,
                                   shader::kUniformLights * sizeof(shader::LightData)});
    commands.bind(shader::kBindingVertices, *inputs.vertices);
    commands.bind(shader::kBindingIndices, *inputs.indices);
    commands.bind(shader::kBindingEnvironment, *inputs.environment, *inputs.texelSampler);
}

void bindDraw(gpu::Commands& commands, const Inputs& inputs, const SurfaceDraw& draw) {
    const auto bindElement = [&](std::uint32_t binding, const gpu::Buffer& buffer,
                                 std::uint32_t index, std::uint64_t bytes) {
        commands.bind(binding, gpu::BufferRange{
                                   &buffer, std::uint64_t{index} * shader::kUniformStride, bytes});
    };
    bindElement(shader::kBindingMesh, *inputs.meshes, draw.mesh, sizeof(shader::MeshData));
    bindElement(shader::kBindingMaterial, *inputs.materials, draw.material,
                sizeof(shader::MaterialData));
    commands.bind(shader::kBindingColorTexture, *draw.colorTexture, *inputs.texelSampler);
    commands.bind(shader::kBindingEmissionTexture, *draw.emissionTexture, *inputs.texelSampler);
}

}  // namespace brume::oit
