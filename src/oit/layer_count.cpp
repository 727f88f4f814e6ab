// SPDX-License-Identifier: Apache-2.0
// What: how many layers each pixel has in front of what is opaque - as many entries as an exact list
//       holds -, or how many fragments rastered methods shade there, misses included; as colours.
// Source: ours.
// Limits: counts are halves: exact up to 2048; the solids of a pixel are one layer together.
// Cost: 2 bytes per pixel (40 more with solids); one raster pass, one to paint.
#include <oit/layer_count.hpp>
#include <oit/layers.hpp>

#include <shaders/common/heat.h>
#include <shaders/oit/layer_count/layer_count.h>
#include <spv/oit/layer_count/media.frag.hpp>
#include <spv/oit/layer_count/resolve.frag.hpp>
#include <spv/oit/layer_count/solid.frag.hpp>
#include <spv/oit/layer_count/surface.frag.hpp>

#include <cmath>

namespace brume::oit::layer_count {
namespace {

constexpr VkFormat kCounts = VK_FORMAT_R16_SFLOAT;

class LayerCount final : public OitMethod {
  public:
    LayerCount(gpu::Device& device, const Inputs& inputs, bool countsMisses)
        : mSolids(device, "oit.layer_count", inputs),
          mPass(device, inputs,
                {.name = "oit.layer_count.store",
                 .shaders = {spv::oit_layer_count_media_frag, spv::oit_layer_count_surface_frag,
                             spv::oit_layer_count_solid_frag},
                 .bindings = {},
                 .specialization = {countsMisses ? 1u : 0u},
                 .colors = {{kCounts, gpu::Blend::additive()}}}),
          mResolve(makeResolve(
              device, "oit.layer_count.resolve", spv::oit_layer_count_resolve_frag,
              {{shader::kBindingLayerCount, gpu::BindingType::SampledImage}}, {})) {}

    const MethodInfo& info() const override { return layer_count::info(); }
    void prepare(const MeasureFunction&) override {}
    void declare(frame::FrameBuilder& frame, const Inputs& inputs) override;
    std::map<std::string, std::uint64_t> counters() override { return {}; }
    std::map<std::string, std::uint64_t> bytes() const override { return {}; }

  private:
    Solids mSolids;
    LayerPass mPass;
    gpu::GraphicsPipeline mResolve;
};

void LayerCount::declare(frame::FrameBuilder& frame, const Inputs& inputs) {
    const SolidTargets solids = mSolids.declare(frame, inputs);
    const frame::ImageRef counts =
        makeLayerTarget(frame, inputs, "oit.layer_count.counts", kCounts);
    frame::PassBuilder& pass = frame.addPass("oit.layer_count.store");
    LayerPass::declareReads(pass, inputs, solids);
    pass.color(counts, gpu::LoadOp::Clear);
    pass.record([this, inputs, solids](gpu::Commands& commands,
                                       const frame::PassResources& resources) {
        mPass.record(commands, resources, inputs, solids);
    });
    declareResolve(frame, inputs, "oit.layer_count.resolve", mResolve,
                   {{shader::kBindingLayerCount, counts}});
}

}  // namespace

const MethodInfo& info() {
    static const MethodInfo kInfo{
        .name = kName,
        .summary = "Counts layers and paints the counts; no image of the scene.",
        .paper = "-",
        .exactness = Exactness::Exact,
        .passes = "1 raster + 1 resolve",
        .bytesPerPixel = "2 (40 more with solids)",
        .limits = "the solids of a pixel are one layer together",
        .settings = {{"counts", "layers, fragments", "layers",
                      "what is in the pixel, or what is shaded for it"}}};
    return kInfo;
}

std::unique_ptr<OitMethod> create(gpu::Device& device, const Inputs& inputs,
                                  const scene::Settings& settings) {
    scene::SettingsReader reader(settings, "setting up the layer count");
    const bool countsMisses =
        reader.choice("counts", "layers", {"layers", "fragments"}) == "fragments";
    reader.finish();
    return std::make_unique<LayerCount>(device, inputs, countsMisses);
}

float heatOf(double layers) {
    if (layers < 1) return 0;
    return static_cast<float>(1 + (shader::kHeatSteps - 1) * std::log2(layers) /
                                      std::log2(shader::kLargestLayerCount));
}

}  // namespace brume::oit::layer_count
