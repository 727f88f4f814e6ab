// SPDX-License-Identifier: Apache-2.0
#include <oit/bindings.hpp>
#include <oit/layers.hpp>

#include <shaders/common/frame_bindings.h>
#include <shaders/oit/layers/layers.h>
#include <shaders/oit/upsample/upsample.h>
#include <spv/common/mesh.vert.hpp>
#include <spv/common/screen.vert.hpp>
#include <spv/oit/layers/media.vert.hpp>
#include <spv/oit/layers/solids.frag.hpp>
#include <spv/oit/unordered/media.frag.hpp>
#include <spv/oit/unordered/solid.frag.hpp>
#include <spv/oit/unordered/surface.frag.hpp>
#include <spv/oit/upsample/over.frag.hpp>

namespace brume::oit {
namespace {

using frame::Access;
using gpu::BindingType;

const gpu::Binding kOpaqueT{shader::kBindingOpaqueT, BindingType::SampledImage};
const std::vector<gpu::Binding> kSolidBindings = {
    {shader::kBindingSolidDepth, BindingType::SampledImage},
    {shader::kBindingSolidSource, BindingType::SampledImage},
    {shader::kBindingSolidRange, BindingType::SampledImage}};

gpu::Blend maximum() {
    gpu::Blend blend = gpu::Blend::additive();
    blend.colorOp = blend.alphaOp = VK_BLEND_OP_MAX;
    return blend;
}

}  // namespace

bool isColoured(const Needs& needs) { return needs.colouredExtinction || needs.colouredSurfaces; }

frame::ImageRef makeLayerTarget(frame::FrameBuilder& frame, const Inputs& inputs,
                                const std::string& name, VkFormat format) {
    return frame.createImage({.name = name,
                              .format = format,
                              .width = inputs.extent.width,
                              .height = inputs.extent.height,
                              .usage = 0});
}

Solids::Solids(gpu::Device& device, const std::string& name, const Inputs& inputs) : mName(name) {
    if (!inputs.needs.solids) return;
    const VkFormat sums = VK_FORMAT_R32G32B32A32_SFLOAT;
    mPipeline = {device,
                 {.name = mName + ".solids",
                  .vertexSpirv = spv::common_mesh_vert,
                  .fragmentSpirv = spv::oit_layers_solids_frag,
                  .bindings = join(surfaceBindings(), {kOpaqueT}),
                  .constants = lightingConstants(inputs.needs),
                  .colors = {{sums, gpu::Blend::additive()},
                             {sums, gpu::Blend::additive()},
                             {VK_FORMAT_R32G32_SFLOAT, maximum()}}}};
}

SolidTargets Solids::declare(frame::FrameBuilder& frame, const Inputs& inputs) const {
    if (!inputs.needs.solids) return {};
    const auto makeTarget = [&](const char* suffix, VkFormat format) {
        return makeLayerTarget(frame, inputs, mName + suffix, format);
    };
    const SolidTargets targets{makeTarget(".solid_depth", VK_FORMAT_R32G32B32A32_SFLOAT),
                               makeTarget(".solid_source", VK_FORMAT_R32G32B32A32_SFLOAT),
                               makeTarget(".solid_range", VK_FORMAT_R32G32_SFLOAT)};
    frame.addPass(mName + ".solids")
        .reads(inputs.opaqueT, Access::FragmentSample)
        .color(targets.depth, gpu::LoadOp::Clear)
        .color(targets.source, gpu::LoadOp::Clear)
        .color(targets.range, gpu::LoadOp::Clear, {-3e38f, 0, 0, 0})
        .record([this, inputs](gpu::Commands& commands, const frame::PassResources& resources) {
            commands.bindGraphics(mPipeline);
            bindFrame(commands, inputs);
            bindMeshes(commands, inputs);
            commands.bind(shader::kBindingOpaqueT, resources.image(inputs.opaqueT),
                          *inputs.texelSampler);
            for (const SurfaceDraw& draw : inputs.surfaces) {
                if (!draw.isSolid) continue;
                bindDraw(commands, inputs, draw);
                commands.draw(draw.vertexCount);
            }
        });
    return targets;
}

LayerPass::LayerPass(gpu::Device& device, const Inputs& inputs, const LayerPassDesc& desc,
                     std::uint32_t kinds)
    : mDrawsSolidFaces(desc.drawsSolidFaces || (inputs.needs.glossy && inputs.needs.solids)),
      mMarks(desc.depthFormat != VK_FORMAT_UNDEFINED && desc.depthUse == DepthUse::Mark) {
    std::vector<std::uint32_t> constants = {inputs.needs.boxes, inputs.needs.varyingDensity,
                                            isColoured(inputs.needs), desc.scale};
    constants.insert(constants.end(), desc.specialization.begin(), desc.specialization.end());
    const auto make = [&](const char* suffix, std::span<const std::uint32_t> vertex,
                          std::span<const std::uint32_t> fragment,
                          const std::vector<gpu::Binding>& bindings) {
        const bool hasDepth = desc.depthFormat != VK_FORMAT_UNDEFINED;
        const bool isTested = hasDepth && desc.depthUse != DepthUse::Idle;
        return gpu::GraphicsPipeline(
            device, {.name = desc.name + suffix,
                     .vertexSpirv = vertex,
                     .fragmentSpirv = fragment,
                     .bindings = join(join(bindings, {kOpaqueT}), desc.bindings),
                     .pushConstantBytes = sizeof(shader::LayerPush),
                     .specialization = constants,
                     .constants = lightingConstants(inputs.needs),
                     .colors = desc.colors,
                     .depthFormat = desc.depthFormat,
                     .depthTest = isTested,
                     .depthWrite = isTested && desc.depthUse != DepthUse::Test,
                     .depthCompare = mMarks ? VK_COMPARE_OP_ALWAYS
                                            : VK_COMPARE_OP_GREATER_OR_EQUAL});
    };
    if ((kinds & kLayersMedia) != 0 && (inputs.needs.spheres || inputs.needs.boxes))
        mMedia = make("_media", spv::oit_layers_media_vert, desc.shaders.media,
                     join(frameBindings(), mediaBindings()));
    if ((kinds & kLayersSurfaces) == 0) return;
    if (inputs.needs.surfaces)
        mSurfaces = make("_surfaces", spv::common_mesh_vert, desc.shaders.surface,
                         surfaceBindings());
    if (inputs.needs.solids)
        mSolids = make("_solids", spv::common_screen_vert, desc.shaders.solid,
                       join(frameBindings(), kSolidBindings));
}

void LayerPass::declareReads(frame::PassBuilder& pass, const Inputs& inputs,
                             const SolidTargets& solids, frame::BufferRef order) {
    pass.reads(inputs.spheres, Access::VertexRead).reads(inputs.opaqueT, Access::FragmentSample);
    if (order) pass.reads(order, Access::VertexRead);
    if (!solids) return;
    for (const frame::ImageRef target : {solids.depth, solids.source, solids.range})
        pass.reads(target, Access::FragmentSample);
}

void LayerPass::recordMedia(gpu::Commands& commands, const frame::PassResources& resources,
                            const Inputs& inputs, const LayerUse& use) const {
    const std::uint32_t count = inputs.sphereCount + inputs.boxCount;
    if (!mMedia || count == 0) return;
    commands.bindGraphics(mMedia);
    bindFrame(commands, inputs);
    bindMedia(commands, inputs, resources.buffer(inputs.spheres), *inputs.boxes);
    commands.bind(shader::kBindingOpaqueT, resources.image(inputs.opaqueT), *inputs.texelSampler);
    if (use.bind) use.bind(commands, resources);
    commands.pushConstants(shader::LayerPush{
        .order = use.order ? resources.address(use.order) : 0,
        .data = use.data,
        .count = count,
        .step = use.step});
    commands.draw(6 * count);
}

void LayerPass::recordSurfaces(gpu::Commands& commands, const frame::PassResources& resources,
                               const Inputs& inputs, const LayerUse& use) const {
    if (!mSurfaces) return;
    commands.bindGraphics(mSurfaces);
    bindFrame(commands, inputs);
    bindMeshes(commands, inputs);
    commands.bind(shader::kBindingOpaqueT, resources.image(inputs.opaqueT), *inputs.texelSampler);
    if (use.bind) use.bind(commands, resources);
    for (const SurfaceDraw& draw : inputs.surfaces) {
        if (draw.isSolid && !mDrawsSolidFaces) continue;
        commands.pushConstants(
            shader::LayerPush{.data = use.data, .mesh = draw.mesh, .step = use.step});
        bindDraw(commands, inputs, draw);
        commands.draw(draw.vertexCount);
    }
}

void LayerPass::recordSolids(gpu::Commands& commands, const frame::PassResources& resources,
                             const Inputs& inputs, const SolidTargets& solids,
                             const LayerUse& use) const {
    if (!mSolids) return;
    commands.bindGraphics(mSolids);
    bindFrame(commands, inputs);
    const gpu::Sampler& sampler = *inputs.texelSampler;
    commands.bind(shader::kBindingOpaqueT, resources.image(inputs.opaqueT), sampler);
    commands.bind(shader::kBindingSolidDepth, resources.image(solids.depth), sampler);
    commands.bind(shader::kBindingSolidSource, resources.image(solids.source), sampler);
    commands.bind(shader::kBindingSolidRange, resources.image(solids.range), sampler);
    if (use.bind) use.bind(commands, resources);
    commands.pushConstants(shader::LayerPush{.data = use.data, .step = use.step});
    commands.draw(3);
}

void LayerPass::record(gpu::Commands& commands, const frame::PassResources& resources,
                       const Inputs& inputs, const SolidTargets& solids,
                       const LayerUse& use) const {
    // Whatever their depth, it shall not become 0.
    if (mMarks)
        commands.setViewport({0, 0, static_cast<float>(inputs.extent.width),
                              static_cast<float>(inputs.extent.height), 0.5f, 1});
    recordMedia(commands, resources, inputs, use);
    recordSurfaces(commands, resources, inputs, use);
    recordSolids(commands, resources, inputs, solids, use);
}

namespace {

gpu::ColorTarget overTarget(const CallersRendering& callers) {
    gpu::ColorTarget target{VK_FORMAT_R32G32B32A32_SFLOAT, gpu::Blend::premultipliedOver()};
    if (!callers) return target;
    target.format = callers.color;
    target.blend.writeMask &= ~VkColorComponentFlags{VK_COLOR_COMPONENT_A_BIT};
    return target;
}

}  // namespace

std::uint32_t readLowResolution(scene::SettingsReader& reader) {
    return static_cast<std::uint32_t>(
        std::stoul(reader.choice(std::string(kLowResolution.name), "1", {"1", "2", "4"})));
}

VkExtent2D lowExtent(const Inputs& inputs, std::uint32_t lowResolution) {
    return {(inputs.extent.width + lowResolution - 1) / lowResolution,
            (inputs.extent.height + lowResolution - 1) / lowResolution};
}

LayerPassDesc OverLayers::describePass(const char* suffix, const CallersRendering& callers) const {
    LayerPassDesc desc;
    desc.name = mName + suffix;
    desc.shaders = {spv::oit_unordered_media_frag, spv::oit_unordered_surface_frag,
                    spv::oit_unordered_solid_frag};
    desc.colors = {overTarget(callers)};
    desc.depthFormat = callers.depth;
    desc.depthUse = DepthUse::Idle;
    return desc;
}

OverLayers::OverLayers(gpu::Device& device, const std::string& name, const Inputs& inputs,
                       std::uint32_t lowResolution)
    : mName(name), mLowResolution(lowResolution), mSolids(device, name, inputs) {
    const LayerPassDesc store = describePass(".store", inputs.callers);
    mPass = LayerPass(device, inputs, store, lowResolution > 1 ? kLayersSurfaces : kLayersAll);
    if (lowResolution == 1) return;
    LayerPassDesc low = describePass(".store_low", {});
    low.scale = lowResolution;
    mLow = LayerPass(device, inputs, low, kLayersMedia);
    mUpsample = {device,
                 {.name = name + ".upsample",
                  .vertexSpirv = spv::common_screen_vert,
                  .fragmentSpirv = spv::oit_upsample_over_frag,
                  .bindings = {kOpaqueT, {shader::kBindingLowMedia, BindingType::SampledImage}},
                  .specialization = {lowResolution},
                  .colors = store.colors,
                  .depthFormat = store.depthFormat}};
}

frame::ImageRef OverLayers::declareLow(frame::FrameBuilder& frame, const Inputs& inputs,
                                       frame::BufferRef order) const {
    if (mLowResolution == 1) return {};
    const VkExtent2D extent = lowExtent(inputs, mLowResolution);
    const frame::ImageRef low = frame.createImage({.name = mName + ".low",
                                                   .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                                   .width = extent.width,
                                                   .height = extent.height,
                                                   .usage = 0});
    frame::PassBuilder& pass = frame.addPass(mName + ".store_low");
    LayerPass::declareReads(pass, inputs, {}, order);
    pass.color(low, gpu::LoadOp::Clear);
    pass.record([this, inputs, order](gpu::Commands& commands,
                                      const frame::PassResources& resources) {
        mLow.record(commands, resources, inputs, {}, {.order = order});
    });
    return low;
}

void OverLayers::declare(frame::FrameBuilder& frame, const Inputs& inputs,
                         frame::BufferRef order) const {
    if (!inputs.callers) declareCopyOfOpaque(frame, inputs, mName + ".clear");
    const SolidTargets solids = mSolids.declare(frame, inputs);
    const frame::ImageRef low = declareLow(frame, inputs, order);
    frame::PassBuilder& pass = frame.addPass(mName + ".store");
    LayerPass::declareReads(pass, inputs, solids, order);
    if (low) pass.reads(low, Access::FragmentSample);
    if (inputs.callers)
        pass.insideCallersRendering();
    else
        pass.color(inputs.result, gpu::LoadOp::Load);
    pass.record([this, inputs, solids, order, low](gpu::Commands& commands,
                                                   const frame::PassResources& resources) {
        if (low) {
            commands.bindGraphics(mUpsample);
            commands.bind(shader::kBindingOpaqueT, resources.image(inputs.opaqueT),
                          *inputs.texelSampler);
            commands.bind(shader::kBindingLowMedia, resources.image(low), *inputs.texelSampler);
            commands.draw(3);
        }
        mPass.record(commands, resources, inputs, solids, {.order = order});
    });
}

gpu::GraphicsPipeline makeResolve(gpu::Device& device, const std::string& name,
                                  std::span<const std::uint32_t> fragment,
                                  const std::vector<gpu::Binding>& bindings,
                                  const std::vector<std::uint32_t>& specialization,
                                  std::uint32_t pushConstantBytes, bool skipsUntouched) {
    return {device,
            {.name = name,
             .vertexSpirv = spv::common_screen_vert,
             .fragmentSpirv = fragment,
             .bindings = join(
                 join(frameBindings(),
                      {kOpaqueT, {shader::kBindingOpaqueColor, BindingType::SampledImage}}),
                 bindings),
             .pushConstantBytes = pushConstantBytes,
             .specialization = specialization,
             .colors = {{VK_FORMAT_R32G32B32A32_SFLOAT, {}}},
             .depthFormat = skipsUntouched ? kTouchedFormat : VK_FORMAT_UNDEFINED,
             .depthTest = skipsUntouched,
             .depthCompare = VK_COMPARE_OP_NOT_EQUAL}};
}

void declareCopyOfOpaque(frame::FrameBuilder& frame, const Inputs& inputs,
                         const std::string& name) {
    frame.addPass(name)
        .reads(inputs.opaqueColor, Access::TransferRead)
        .writes(inputs.result, Access::TransferWrite)
        .record([inputs](gpu::Commands& commands, const frame::PassResources& resources) {
            commands.copyImage(resources.image(inputs.opaqueColor),
                               resources.image(inputs.result));
        });
}

frame::PassBuilder& declareResolve(frame::FrameBuilder& frame, const Inputs& inputs, const std::string& name,
                    const gpu::GraphicsPipeline& pipeline,
                    std::vector<std::pair<std::uint32_t, frame::ImageRef>> images,
                    const std::function<void(gpu::Commands&)>& push,
                    frame::ImageRef touched) {
    if (touched) declareCopyOfOpaque(frame, inputs, name + "_untouched");
    images.emplace_back(shader::kBindingOpaqueT, inputs.opaqueT);
    images.emplace_back(shader::kBindingOpaqueColor, inputs.opaqueColor);
    frame::PassBuilder& pass = frame.addPass(name);
    for (const auto& [binding, image] : images) pass.reads(image, Access::FragmentSample);
    pass.color(inputs.result, touched ? gpu::LoadOp::Load : gpu::LoadOp::DontCare);
    if (touched) pass.depthTest(touched);
    pass.record([inputs, images, push, &pipeline](gpu::Commands& commands,
                                                  const frame::PassResources& resources) {
        commands.bindGraphics(pipeline);
        bindFrame(commands, inputs);
        for (const auto& [binding, image] : images)
            commands.bind(binding, resources.image(image), *inputs.texelSampler);
        if (push) push(commands);
        commands.draw(3);
    });
    return pass;
}

}  // namespace brume::oit
