// SPDX-License-Identifier: Apache-2.0
// What: order-independent transparency by screen-door samples: each layer stops light in a random,
//       stratified set of samples; what is seen in them gives the image, right in expectation.
// Source: E. Enderton, E. Sintorn, P. Shirley, D. Luebke: "Stochastic Transparency", IEEE TVCG
//         17(8), 2011, DOI 10.1109/TVCG.2010.123.
// Equations: section 3.1 (masks) -> sampleThresholds(); 3.3 (alpha correction), 3.4 (depth-based) ->
//         gather.glsl, resolve.frag.
// Differs: samples are channels of colour targets kept by minimum blending, not MSAA: one pass holds
//         16 of them, any device has them, and multisampled targets cost several times as much on
//         software devices; masks are never tabulated, so that no alpha is too small for them;
//         colours have thresholds of their own with one random number for all three; a medium stops
//         light where its loss so far reaches the sample's threshold, a free flight.
// Limits: noise; samples share their place in the pixel, edges are smoothed by the image's
//         supersampling only; bricks and boxes count as homogeneous inside; empty pixels of `alpha`
//         lose the layers' radiance.
// Cost: per 16 samples (coloured: 8) two raster passes; bytes per pixel as info() says.
#include <oit/layers.hpp>
#include <oit/oit_method.hpp>

#include <shaders/oit/stochastic/stochastic.h>
#include <spv/oit/stochastic/gather_media.frag.hpp>
#include <spv/oit/stochastic/gather_solid.frag.hpp>
#include <spv/oit/stochastic/gather_surface.frag.hpp>
#include <spv/oit/stochastic/resolve.frag.hpp>
#include <spv/oit/stochastic/store_media.frag.hpp>
#include <spv/oit/stochastic/store_solid.frag.hpp>
#include <spv/oit/stochastic/store_surface.frag.hpp>

#include <algorithm>

namespace brume::oit::stochastic {
namespace {

using frame::Access;

constexpr VkFormat kFormat = VK_FORMAT_R32G32B32A32_SFLOAT;

struct Settings {
    std::uint32_t samples = 4;
    bool isNaive = false;
    std::uint32_t estimator = shader::kEstimatorDepthAlpha;
    std::uint32_t seed = shader::kSeedPrimitive;
    std::uint32_t pattern = 0;
};

template <std::size_t N>
std::uint32_t indexOf(const std::string& word, const char* const (&words)[N]) {
    return static_cast<std::uint32_t>(std::find(words, words + N, word) - words);
}

Settings readSettings(const scene::Settings& given) {
    scene::SettingsReader reader(given, "setting up method stochastic");
    Settings s;
    s.samples = static_cast<std::uint32_t>(
        std::stoul(reader.choice("samples", "4", {"1", "2", "4", "8", "16", "32", "64"})));
    s.isNaive = reader.choice("mask", "stratified", {"naive", "stratified"}) == "naive";
    // In the order of kEstimator... and kSeed...
    static constexpr const char* kEstimators[] = {"basic", "alpha", "depth", "depth_alpha"};
    static constexpr const char* kSeeds[] = {"primitive", "object", "depth"};
    s.estimator = indexOf(
        reader.choice("estimator", "depth_alpha", {"basic", "alpha", "depth", "depth_alpha"}),
        kEstimators);
    s.seed = indexOf(reader.choice("seed", "primitive", {"primitive", "object", "depth"}), kSeeds);
    s.pattern = static_cast<std::uint32_t>(reader.integer("pattern", 0, 0, 0xffffffffll));
    reader.finish();
    return s;
}

class Stochastic final : public OitMethod {
  public:
    Stochastic(gpu::Device& device, const Inputs& inputs, const Settings& settings);

    const MethodInfo& info() const override;
    void prepare(const MeasureFunction&) override {}
    void declare(frame::FrameBuilder& frame, const Inputs& inputs) override;
    std::map<std::string, std::uint64_t> counters() override {
        return {{"samplePasses", mPassCount}};
    }
    std::map<std::string, std::uint64_t> bytes() const override { return {}; }

  private:
    std::uint32_t imageCount() const { return mImagesPerChannel * (mIsColoured ? 3 : 1); }
    std::vector<std::uint32_t> constants() const;
    LayerPassDesc describeStore(bool withTotal) const;
    LayerPassDesc describeGather() const;
    void declareStep(frame::FrameBuilder& frame, const Inputs& inputs, const SolidTargets& solids,
                     std::uint32_t step, frame::ImageRef total,
                     const std::vector<frame::ImageRef>& sums) const;

    Settings mSettings;
    bool mIsColoured;
    std::uint32_t mImagesPerChannel, mPassCount;
    Solids mSolids;
    LayerPass mStore, mStoreMore, mGather;
    gpu::GraphicsPipeline mResolve;
};

Stochastic::Stochastic(gpu::Device& device, const Inputs& inputs, const Settings& settings)
    : mSettings(settings),
      mIsColoured(isColoured(inputs.needs)),
      mSolids(device, "oit.stochastic", inputs) {
    const std::uint32_t groups = std::max(settings.samples / shader::kSamplesPerImage, 1u);
    mImagesPerChannel = std::min(groups, mIsColoured ? 2u : 4u);
    mPassCount = groups / mImagesPerChannel;
    mStore = LayerPass(device, inputs, describeStore(true));
    if (mPassCount > 1) mStoreMore = LayerPass(device, inputs, describeStore(false));
    mGather = LayerPass(device, inputs, describeGather());
    mResolve = makeResolve(device, "oit.stochastic.resolve", spv::oit_stochastic_resolve_frag,
                           {{shader::kBindingStochasticTotal, gpu::BindingType::SampledImage},
                            {shader::kBindingStochasticSum, gpu::BindingType::SampledImage},
                            {shader::kBindingStochasticWeights, gpu::BindingType::SampledImage}},
                           {mIsColoured, mSettings.estimator});
}

std::vector<std::uint32_t> Stochastic::constants() const {
    const bool seesWinners = mSettings.estimator == shader::kEstimatorBasic ||
                             mSettings.estimator == shader::kEstimatorAlpha;
    return {mSettings.samples, mImagesPerChannel, mSettings.isNaive,
            mSettings.seed,    mSettings.pattern, seesWinners};
}

LayerPassDesc Stochastic::describeStore(bool withTotal) const {
    gpu::Blend total = gpu::Blend::additive(), nearest = gpu::Blend::additive();
    if (!withTotal) total.writeMask = 0;  // the first pass has added it up
    nearest.colorOp = nearest.alphaOp = VK_BLEND_OP_MIN;
    std::vector<gpu::ColorTarget> colors(1 + imageCount(), {kFormat, nearest});
    colors[0].blend = total;
    return {.name = "oit.stochastic.store",
            .shaders = {spv::oit_stochastic_store_media_frag,
                        spv::oit_stochastic_store_surface_frag,
                        spv::oit_stochastic_store_solid_frag},
            .bindings = {},
            .specialization = constants(),
            .colors = colors};
}

LayerPassDesc Stochastic::describeGather() const {
    std::vector<gpu::Binding> bindings;
    for (std::uint32_t i = 0; i < shader::kMaxSampleImages; ++i)
        bindings.push_back({shader::kBindingSamples + i, gpu::BindingType::SampledImage});
    return {.name = "oit.stochastic.gather",
            .shaders = {spv::oit_stochastic_gather_media_frag,
                        spv::oit_stochastic_gather_surface_frag,
                        spv::oit_stochastic_gather_solid_frag},
            .bindings = bindings,
            .specialization = constants(),
            .colors = std::vector<gpu::ColorTarget>(mIsColoured ? 2 : 1,
                                                    {kFormat, gpu::Blend::additive()})};
}

void Stochastic::declareStep(frame::FrameBuilder& frame, const Inputs& inputs,
                             const SolidTargets& solids, std::uint32_t step, frame::ImageRef total,
                             const std::vector<frame::ImageRef>& sums) const {
    const gpu::LoadOp load = step == 0 ? gpu::LoadOp::Clear : gpu::LoadOp::Load;
    std::vector<frame::ImageRef> samples;
    frame::PassBuilder& store = frame.addPass("oit.stochastic.store");
    LayerPass::declareReads(store, inputs, solids);
    store.color(total, load);
    for (std::uint32_t i = 0; i < imageCount(); ++i) {
        samples.push_back(makeLayerTarget(frame, inputs, "oit.stochastic.samples", kFormat));
        const float far = shader::kNoSample;
        store.color(samples.back(), gpu::LoadOp::Clear, {far, far, far, far});
    }
    store.record([this, inputs, solids, step](gpu::Commands& commands,
                                              const frame::PassResources& resources) {
        (step == 0 ? mStore : mStoreMore)
            .record(commands, resources, inputs, solids, {.step = step});
    });

    frame::PassBuilder& gather = frame.addPass("oit.stochastic.gather");
    LayerPass::declareReads(gather, inputs, solids);
    for (const frame::ImageRef image : samples) gather.reads(image, Access::FragmentSample);
    for (const frame::ImageRef sum : sums) gather.color(sum, load);
    const auto bind = [inputs, samples](gpu::Commands& commands,
                                                   const frame::PassResources& resources) {
        // Bindings that the specialised shader does not read get any of them.
        for (std::uint32_t i = 0; i < shader::kMaxSampleImages; ++i)
            commands.bind(shader::kBindingSamples + i,
                          resources.image(samples[std::min<std::size_t>(i, samples.size() - 1)]),
                          *inputs.texelSampler);
    };
    gather.record([this, inputs, solids, step, bind](gpu::Commands& commands,
                                                     const frame::PassResources& resources) {
        mGather.record(commands, resources, inputs, solids, {.bind = bind, .step = step});
    });
}

void Stochastic::declare(frame::FrameBuilder& frame, const Inputs& inputs) {
    const SolidTargets solids = mSolids.declare(frame, inputs);
    const frame::ImageRef total = makeLayerTarget(frame, inputs, "oit.stochastic.total", kFormat);
    std::vector<frame::ImageRef> sums = {makeLayerTarget(frame, inputs, "oit.stochastic.sum", kFormat)};
    if (mIsColoured) sums.push_back(makeLayerTarget(frame, inputs, "oit.stochastic.weights", kFormat));
    for (std::uint32_t step = 0; step < mPassCount; ++step)
        declareStep(frame, inputs, solids, step, total, sums);

    declareResolve(frame, inputs, "oit.stochastic.resolve", mResolve,
                   {{shader::kBindingStochasticTotal, total},
                    {shader::kBindingStochasticSum, sums.front()},
                    {shader::kBindingStochasticWeights, sums.back()}});
}

}  // namespace

const MethodInfo& info() {
    static const MethodInfo kInfo{
        .name = "stochastic",
        .summary = "Each layer stops light in a random set of samples; right in expectation, also "
                   "where media overlap.",
        .paper = "Enderton, Sintorn, Shirley, Luebke: Stochastic Transparency, 2011",
        .exactness = Exactness::Approximate,
        .passes = "2 raster per 16 samples (8 with colours) + 1 resolve",
        .bytesPerPixel = "32 + 4 S, S <= 16 samples in a pass; 48 + 12 S, S <= 8 with colours",
        .limits = "noise; bricks and boxes count as homogeneous inside",
        .weaknesses = {Weakness::Noise, Weakness::Profile, Weakness::Emission},
        .settings = {{"samples", "1, 2, 4, 8, 16, 32, 64", "4", "per pixel"},
                     {"mask", "naive, stratified", "stratified",
                      "samples chosen each by itself, or as even shares"},
                     {"estimator", "basic, alpha, depth, depth_alpha", "depth_alpha",
                      "basic and depth are unbiased, *alpha corrects the total"},
                     {"seed", "primitive, object, depth", "primitive", "what the noise sticks to"},
                     {"pattern", "0..4294967295", "0", "which noise"}}};
    return kInfo;
}

const MethodInfo& Stochastic::info() const { return stochastic::info(); }

std::unique_ptr<OitMethod> create(gpu::Device& device, const Inputs& inputs,
                                  const scene::Settings& settings) {
    return std::make_unique<Stochastic>(device, inputs, readSettings(settings));
}

}  // namespace brume::oit::stochastic
