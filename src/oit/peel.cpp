// SPDX-License-Identifier: Apache-2.0
// What: depth peeling: each pass finds the nearest layer behind those already found, by the depth
//       test, and composites it.
// Source: C. Everitt: "Interactive Order-Independent Transparency", NVIDIA, 2001.
// Differs: layers are composited as they are found, so that memory does not grow with their number.
// Limits: what lies behind the peeled layers is not there; two layers at the same distance are one;
//         overlapping media are ordered by their middles, not mixed.
// Cost: N raster passes over everything; 68 bytes per pixel.
#include <oit/layers.hpp>
#include <oit/oit_method.hpp>

#include <shaders/oit/peel/peel.h>
#include <spv/common/screen.vert.hpp>
#include <spv/oit/peel/carry.frag.hpp>
#include <spv/oit/peel/resolve.frag.hpp>
#include <spv/oit/peel/store_media.frag.hpp>
#include <spv/oit/peel/store_solid.frag.hpp>
#include <spv/oit/peel/store_surface.frag.hpp>

namespace brume::oit::peel {
namespace {

using frame::Access;

constexpr VkFormat kFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

const std::vector<gpu::Binding> kState = {
    {shader::kBindingPeelRadiance, gpu::BindingType::SampledImage},
    {shader::kBindingPeelTransmittance, gpu::BindingType::SampledImage}};

struct State {
    frame::ImageRef radiance, transmittance;
};

class Peel final : public OitMethod {
  public:
    Peel(gpu::Device& device, const Inputs& inputs, std::uint32_t layers);

    const MethodInfo& info() const override;
    void prepare(const MeasureFunction&) override {}
    void declare(frame::FrameBuilder& frame, const Inputs& inputs) override;
    std::map<std::string, std::uint64_t> counters() override { return {{"layers", mLayers}}; }
    std::map<std::string, std::uint64_t> bytes() const override { return {}; }

  private:
    void declareStep(frame::FrameBuilder& frame, const Inputs& inputs, const SolidTargets& solids,
                     const State& before, const State& after, frame::ImageRef depth) const;

    std::uint32_t mLayers;
    Solids mSolids;
    LayerPass mStore;
    gpu::GraphicsPipeline mCarry, mResolve;
};

Peel::Peel(gpu::Device& device, const Inputs& inputs, std::uint32_t layers)
    : mLayers(layers),
      mSolids(device, "oit.peel", inputs),
      mStore(device, inputs,
             {.name = "oit.peel.store",
              .shaders = {spv::oit_peel_store_media_frag, spv::oit_peel_store_surface_frag,
                          spv::oit_peel_store_solid_frag},
              .bindings = kState,
              .specialization = {},
              .colors = {{kFormat, {}}, {kFormat, {}}},
              .depthFormat = kDepthFormat}),
      mCarry(device, {.name = "oit.peel.carry",
                      .vertexSpirv = spv::common_screen_vert,
                      .fragmentSpirv = spv::oit_peel_carry_frag,
                      .bindings = kState,
                      .colors = {{kFormat, {}}, {kFormat, {}}},
                      .depthFormat = kDepthFormat,
                      .depthTest = true,
                      .depthWrite = true}),
      mResolve(makeResolve(device, "oit.peel.resolve", spv::oit_peel_resolve_frag, kState, {})) {}

void Peel::declareStep(frame::FrameBuilder& frame, const Inputs& inputs,
                       const SolidTargets& solids, const State& before, const State& after,
                       frame::ImageRef depth) const {
    frame::PassBuilder& pass = frame.addPass("oit.peel.store");
    LayerPass::declareReads(pass, inputs, solids);
    pass.reads(before.radiance, Access::FragmentSample)
        .reads(before.transmittance, Access::FragmentSample)
        .color(after.radiance, gpu::LoadOp::DontCare)
        .color(after.transmittance, gpu::LoadOp::DontCare)
        .depth(depth, gpu::LoadOp::Clear);
    const auto bind = [inputs, before](gpu::Commands& commands,
                                       const frame::PassResources& resources) {
        commands.bind(shader::kBindingPeelRadiance, resources.image(before.radiance),
                      *inputs.texelSampler);
        commands.bind(shader::kBindingPeelTransmittance, resources.image(before.transmittance),
                      *inputs.texelSampler);
    };
    pass.record([this, inputs, solids, bind](gpu::Commands& commands,
                                             const frame::PassResources& resources) {
        commands.bindGraphics(mCarry);
        bind(commands, resources);
        commands.draw(3);
        mStore.record(commands, resources, inputs, solids, {.bind = bind});
    });
}

void Peel::declare(frame::FrameBuilder& frame, const Inputs& inputs) {
    const SolidTargets solids = mSolids.declare(frame, inputs);
    State states[2];
    for (State& state : states)
        state = {makeLayerTarget(frame, inputs, "oit.peel.radiance", kFormat),
                 makeLayerTarget(frame, inputs, "oit.peel.transmittance", kFormat)};
    const frame::ImageRef depth = makeLayerTarget(frame, inputs, "oit.peel.depth", kDepthFormat);
    frame.addPass("oit.peel.clear")
        .color(states[0].radiance, gpu::LoadOp::Clear, {0, 0, 0, -1})
        .color(states[0].transmittance, gpu::LoadOp::Clear, {1, 1, 1, 0})
        .record([](gpu::Commands&, const frame::PassResources&) {});
    for (std::uint32_t i = 0; i < mLayers; ++i)
        declareStep(frame, inputs, solids, states[i % 2], states[(i + 1) % 2], depth);
    const State& last = states[mLayers % 2];
    declareResolve(frame, inputs, "oit.peel.resolve", mResolve,
                   {{shader::kBindingPeelRadiance, last.radiance},
                    {shader::kBindingPeelTransmittance, last.transmittance}});
}

}  // namespace

const MethodInfo& info() {
    static const MethodInfo kInfo{
        .name = "peel",
        .summary = "Depth peeling: one pass over everything for each of the nearest N layers.",
        .paper = "Everitt: Interactive Order-Independent Transparency, 2001",
        .exactness = Exactness::Approximate,
        .passes = "N raster + 1 resolve",
        .bytesPerPixel = "68 (40 more with solids)",
        .limits = "nothing behind the nearest N layers; layers at one distance count once; overlapping media "
                  "are not mixed",
        .weaknesses = {Weakness::ManyLayers, Weakness::LostLayers, Weakness::Overlap},
        .settings = {{"layers", "1..256", "8", "N, how many are peeled"}}};
    return kInfo;
}

const MethodInfo& Peel::info() const { return peel::info(); }

std::unique_ptr<OitMethod> create(gpu::Device& device, const Inputs& inputs,
                                  const scene::Settings& settings) {
    scene::SettingsReader reader(settings, "setting up method peel");
    const auto layers = static_cast<std::uint32_t>(reader.integer("layers", 8, 1, 256));
    reader.finish();
    return std::make_unique<Peel>(device, inputs, layers);
}

}  // namespace brume::oit::peel
