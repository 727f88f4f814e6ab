// SPDX-License-Identifier: Apache-2.0
// What: exactly the nearest K layers of each pixel, composited in order, before sums of the rest.
// Source: L. Bavoil, S. Callahan, A. Lefohn, J. Comba, C. Silva: "Multi-Fragment Effects on the GPU
//         Using the k-Buffer", I3D 2007, DOI 10.1145/1230100.1230117; the tail as in M. Maule, J.
//         Comba, R. Torchelsen, R. Bastos: "Hybrid Transparency", I3D 2013.
// Differs: no ordered access: a chain of 64-bit atomic minima keeps the K smallest keys (distance,
//         id) whatever the order of arrival, a second pass stores the layers that own them; the tail
//         is commutative. So the image does not depend on the order of submission.
// Limits: overlapping media are ordered by their middles, not mixed; the rest has a mean radiance.
// Cost: two raster passes, one resolve; 32 K + 32 bytes per pixel. Needs 64-bit buffer atomics.
#include <core/error.hpp>
#include <gpu/device.hpp>
#include <oit/layers.hpp>
#include <oit/oit_method.hpp>

#include <shaders/oit/k_buffer/k_buffer.h>
#include <spv/oit/k_buffer/keys_media.frag.hpp>
#include <spv/oit/k_buffer/keys_solid.frag.hpp>
#include <spv/oit/k_buffer/keys_surface.frag.hpp>
#include <spv/oit/k_buffer/resolve.frag.hpp>
#include <spv/oit/k_buffer/store_media.frag.hpp>
#include <spv/oit/k_buffer/store_solid.frag.hpp>
#include <spv/oit/k_buffer/store_surface.frag.hpp>

namespace brume::oit::k_buffer {
namespace {

using frame::Access;

constexpr VkFormat kFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr std::uint64_t kKeyBytes = 8;

/// The layers behind the nearest K, and which pixels have any.
struct Tail {
    frame::ImageRef sum, depth, touched;
};

class KBuffer final : public OitMethod {
  public:
    KBuffer(gpu::Device& device, const Inputs& inputs, std::uint32_t layers);

    const MethodInfo& info() const override;
    void prepare(const MeasureFunction&) override {}
    void declare(frame::FrameBuilder& frame, const Inputs& inputs) override;
    std::map<std::string, std::uint64_t> counters() override { return {{"layers", mLayers}}; }
    std::map<std::string, std::uint64_t> bytes() const override {
        return {{"lists", mData.bytes()}};
    }

  private:
    void declareKeys(frame::FrameBuilder& frame, const Inputs& inputs,
                     const SolidTargets& solids) const;
    void declareStore(frame::FrameBuilder& frame, const Inputs& inputs, const SolidTargets& solids,
                      const Tail& tail) const;

    std::uint32_t mLayers;
    std::uint64_t mSlots;
    Solids mSolids;
    LayerPass mKeys, mStore;
    gpu::GraphicsPipeline mResolve;
    gpu::Buffer mData;
};

KBuffer::KBuffer(gpu::Device& device, const Inputs& inputs, std::uint32_t layers)
    : mLayers(layers),
      mSlots(std::uint64_t{inputs.extent.width} * inputs.extent.height * layers),
      mSolids(device, "oit.k_buffer", inputs),
      mKeys(device, inputs,
            {.name = "oit.k_buffer.keys",
             .shaders = {spv::oit_k_buffer_keys_media_frag, spv::oit_k_buffer_keys_surface_frag,
                         spv::oit_k_buffer_keys_solid_frag},
             .bindings = {},
             .specialization = {layers},
             .colors = {}}),
      mStore(device, inputs,
             {.name = "oit.k_buffer.store",
              .shaders = {spv::oit_k_buffer_store_media_frag, spv::oit_k_buffer_store_surface_frag,
                          spv::oit_k_buffer_store_solid_frag},
              .bindings = {},
              .specialization = {layers},
              .colors = {{kFormat, gpu::Blend::additive()}, {kFormat, gpu::Blend::additive()}},
              .depthFormat = kTouchedFormat,
              .depthUse = DepthUse::Mark}),
      mResolve(makeResolve(device, "oit.k_buffer.resolve", spv::oit_k_buffer_resolve_frag,
                           {{shader::kBindingTailSum, gpu::BindingType::SampledImage},
                            {shader::kBindingTailDepth, gpu::BindingType::SampledImage}},
                           {layers}, sizeof(shader::KResolvePush), true)),
      mData(device, {.name = "oit.k_buffer.layers",
                     .bytes = mSlots * (kKeyBytes + sizeof(shader::KLayer))}) {}

void KBuffer::declareKeys(frame::FrameBuilder& frame, const Inputs& inputs,
                          const SolidTargets& solids) const {
    const frame::BufferRef data = frame.importBuffer(mData);
    frame.addPass("oit.k_buffer.clear")
        .writes(data, Access::TransferWrite)
        .record([this](gpu::Commands& commands, const frame::PassResources&) {
            commands.fillBuffer(mData, ~0u, 0, mSlots * kKeyBytes);
        });
    frame::PassBuilder& pass = frame.addPass("oit.k_buffer.keys");
    LayerPass::declareReads(pass, inputs, solids);
    pass.readsWrites(data, Access::FragmentWrite).renderArea(inputs.extent);
    pass.record([this, inputs, solids](gpu::Commands& commands,
                                       const frame::PassResources& resources) {
        mKeys.record(commands, resources, inputs, solids, {.data = mData.deviceAddress()});
    });
}

void KBuffer::declareStore(frame::FrameBuilder& frame, const Inputs& inputs,
                           const SolidTargets& solids, const Tail& tail) const {
    frame::PassBuilder& pass = frame.addPass("oit.k_buffer.store");
    LayerPass::declareReads(pass, inputs, solids);
    pass.readsWrites(frame.importBuffer(mData), Access::FragmentWrite)
        .color(tail.sum, gpu::LoadOp::Clear)
        .color(tail.depth, gpu::LoadOp::Clear)
        .depth(tail.touched, gpu::LoadOp::Clear);
    pass.record([this, inputs, solids](gpu::Commands& commands,
                                       const frame::PassResources& resources) {
        mStore.record(commands, resources, inputs, solids, {.data = mData.deviceAddress()});
    });
}

void KBuffer::declare(frame::FrameBuilder& frame, const Inputs& inputs) {
    const SolidTargets solids = mSolids.declare(frame, inputs);
    declareKeys(frame, inputs, solids);
    const Tail tail{makeLayerTarget(frame, inputs, "oit.k_buffer.tail_sum", kFormat),
                    makeLayerTarget(frame, inputs, "oit.k_buffer.tail_depth", kFormat),
                    makeLayerTarget(frame, inputs, "oit.k_buffer.touched", kTouchedFormat)};
    declareStore(frame, inputs, solids, tail);
    declareResolve(frame, inputs, "oit.k_buffer.resolve", mResolve,
                   {{shader::kBindingTailSum, tail.sum}, {shader::kBindingTailDepth, tail.depth}},
                   [this](gpu::Commands& commands) {
                       commands.pushConstants(shader::KResolvePush{mData.deviceAddress()});
                   },
                   tail.touched);
}

}  // namespace

const MethodInfo& info() {
    static const MethodInfo kInfo{
        .name = "k_buffer",
        .summary = "Exactly the nearest K layers in order, the mean of the rest behind them.",
        .paper = "Bavoil, Callahan, Lefohn, Comba, Silva: Multi-Fragment Effects on the GPU Using "
                 "the k-Buffer, 2007",
        .exactness = Exactness::Approximate,
        .passes = "2 raster + 1 resolve",
        .bytesPerPixel = "32 K + 34 (40 more with solids)",
        .limits = "overlapping media are not mixed; needs 64-bit atomics on buffers",
        .weaknesses = {Weakness::ManyLayers, Weakness::Overlap},
        .settings = {{"layers", "1..64", "8", "K, how many are kept in order"}}};
    return kInfo;
}

const MethodInfo& KBuffer::info() const { return k_buffer::info(); }

std::unique_ptr<OitMethod> create(gpu::Device& device, const Inputs& inputs,
                                  const scene::Settings& settings) {
    scene::SettingsReader reader(settings, "setting up method k_buffer");
    const auto layers = static_cast<std::uint32_t>(reader.integer("layers", 8, 1, 64));
    reader.finish();
    if (!device.features().shaderInt64Atomics)
        throw failure("setting up method k_buffer", device.info().name,
                      "has no 64-bit atomics on buffers, which the method needs");
    return std::make_unique<KBuffer>(device, inputs, layers);
}

}  // namespace brume::oit::k_buffer
