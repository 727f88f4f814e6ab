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
//         Edges are smoothed by supersampling the image, whose pixels then share one mask.
//         Adaptive: each pass has a mask of its own, and a pixel gets no more of them once its
//         standard error, as found from how passes differ, is small enough.
// Limits: noise; bricks and boxes count as homogeneous inside; empty pixels of `alpha` lose the
//         layers' radiance; what no sample has met yet has no variance, so that adaptive pixels with
//         nothing but very rare light may end too early.
// Cost: per 16 samples (coloured: 8) two raster passes; bytes per pixel as info() says.
#include <oit/layers.hpp>
#include <oit/stochastic_settings.hpp>

#include <shaders/common/frame_bindings.h>
#include <shaders/oit/stochastic/stochastic.h>
#include <spv/common/screen.vert.hpp>
#include <spv/oit/stochastic/collect.frag.hpp>
#include <spv/oit/stochastic/filter.frag.hpp>
#include <spv/oit/stochastic/gather_media.frag.hpp>
#include <spv/oit/stochastic/gather_solid.frag.hpp>
#include <spv/oit/stochastic/gather_surface.frag.hpp>
#include <spv/oit/stochastic/resolve.frag.hpp>
#include <spv/oit/stochastic/stop.frag.hpp>
#include <spv/oit/stochastic/store_media.frag.hpp>
#include <spv/oit/stochastic/store_solid.frag.hpp>
#include <spv/oit/stochastic/store_surface.frag.hpp>

#include <algorithm>
#include <bit>

namespace brume::oit::stochastic {
namespace {

using frame::Access;

constexpr VkFormat kFormat = VK_FORMAT_R32G32B32A32_SFLOAT;

constexpr VkFormat kMaskFormat = VK_FORMAT_D32_SFLOAT;

/// Sums over the passes of an adaptive frame, and which pixels take no more part.
struct AdaptiveTargets {
    frame::ImageRef means, squares, sum, weights, mask;
};

struct Targets {
    frame::ImageRef total, sum, weights;  // weights: of colours
    frame::ImageRef touched;              // if not adaptive
    AdaptiveTargets all;
};

class Stochastic final : public OitMethod {
  public:
    Stochastic(gpu::Device& device, const Inputs& inputs, const Settings& settings);

    const MethodInfo& info() const override;
    void prepare(const MeasureFunction&) override {}
    void declare(frame::FrameBuilder& frame, const Inputs& inputs) override;
    std::map<std::string, std::uint64_t> counters() override;
    std::map<std::string, std::uint64_t> bytes() const override { return {}; }

  private:
    std::uint32_t samplesPerPass() const { return shader::kSamplesPerImage * mImagesPerChannel; }
    bool skipsUntouched() const { return !mSettings.isAdaptive() && mSettings.filter == 0; }
    std::uint32_t imageCount() const { return mImagesPerChannel * (mIsColoured ? 3 : 1); }
    std::vector<std::uint32_t> layerConstants(std::uint32_t supersample) const;
    LayerPassDesc describePass(const char* suffix, const LayerShaders& shaders) const;
    void makeLayerPasses(gpu::Device& device, const Inputs& inputs);
    void makeAdaptivePasses(gpu::Device& device);
    void makeResolves(gpu::Device& device);

    Targets makeTargets(frame::FrameBuilder& frame, const Inputs& inputs) const;
    std::vector<frame::ImageRef> declareStore(frame::FrameBuilder& frame, const Inputs& inputs,
                                              const SolidTargets& solids, const Targets& targets,
                                              std::uint32_t step) const;
    void declareGather(frame::FrameBuilder& frame, const Inputs& inputs,
                       const SolidTargets& solids, const Targets& targets,
                       const std::vector<frame::ImageRef>& samples, std::uint32_t step) const;
    void declareCollect(frame::FrameBuilder& frame, const Inputs& inputs, const Targets& targets,
                        std::uint32_t step) const;
    void declareStop(frame::FrameBuilder& frame, const Inputs& inputs,
                     const Targets& targets) const;
    void declareResolves(frame::FrameBuilder& frame, const Inputs& inputs,
                         const Targets& targets) const;

    Settings mSettings;
    bool mIsColoured;
    std::uint32_t mImagesPerChannel, mPassCount;
    std::vector<std::uint32_t> mEstimateConstants;
    Solids mSolids;
    LayerPass mStore, mStoreMore, mGather;
    gpu::GraphicsPipeline mCollect, mStop, mResolve, mFilter;
    gpu::Buffer mCounters, mCountersRead;
};

Stochastic::Stochastic(gpu::Device& device, const Inputs& inputs, const Settings& settings)
    : mSettings(settings),
      mIsColoured(isColoured(inputs.needs)),
      mSolids(device, "oit.stochastic", inputs) {
    const std::uint32_t groups = std::max(settings.samples / shader::kSamplesPerImage, 1u);
    mImagesPerChannel = std::min(groups, mIsColoured ? 2u : 4u);
    mPassCount = groups / mImagesPerChannel;
    mEstimateConstants = {mIsColoured, settings.estimator, settings.isAdaptive(),
                          std::bit_cast<std::uint32_t>(settings.error), settings.filter};
    makeLayerPasses(device, inputs);
    if (settings.isAdaptive()) makeAdaptivePasses(device);
    makeResolves(device);
}

std::vector<std::uint32_t> Stochastic::layerConstants(std::uint32_t supersample) const {
    const bool seesWinners = mSettings.estimator == shader::kEstimatorBasic ||
                             mSettings.estimator == shader::kEstimatorAlpha;
    // An adaptive pixel may end after any pass: each is stratified by itself.
    const std::uint32_t samples = mSettings.isAdaptive() ? samplesPerPass() : mSettings.samples;
    // One mask spreads over all samples of a pixel of the image, each at its own place in it.
    const std::uint32_t edge =
        std::has_single_bit(supersample) && samples >= shader::kSamplesPerImage ? supersample : 1;
    return {samples * edge * edge, mImagesPerChannel,
            mSettings.isNaive,     mSettings.seed,
            mSettings.pattern,     seesWinners,
            mSettings.isAdaptive(), edge};
}

LayerPassDesc Stochastic::describePass(const char* suffix, const LayerShaders& shaders) const {
    LayerPassDesc desc;
    desc.name = std::string("oit.stochastic") + suffix;
    desc.shaders = shaders;
    desc.depthFormat = mSettings.isAdaptive() ? kMaskFormat : VK_FORMAT_UNDEFINED;
    desc.depthUse = DepthUse::Test;
    return desc;
}

void Stochastic::makeLayerPasses(gpu::Device& device, const Inputs& inputs) {
    gpu::Blend nearest = gpu::Blend::additive();
    nearest.colorOp = nearest.alphaOp = VK_BLEND_OP_MIN;
    LayerPassDesc store = describePass(
        ".store", {spv::oit_stochastic_store_media_frag, spv::oit_stochastic_store_surface_frag,
                   spv::oit_stochastic_store_solid_frag});
    store.specialization = layerConstants(inputs.supersample);
    store.colors.assign(1 + imageCount(), {kFormat, nearest});
    store.colors[0].blend = gpu::Blend::additive();
    if (skipsUntouched()) {
        store.depthFormat = kTouchedFormat;
        store.depthUse = DepthUse::Mark;
    }
    mStore = LayerPass(device, inputs, store);
    // The first pass has added up the total, and marked.
    store.colors[0].blend.writeMask = 0;
    if (!mSettings.isAdaptive()) store.depthFormat = VK_FORMAT_UNDEFINED;
    if (mPassCount > 1) mStoreMore = LayerPass(device, inputs, store);

    LayerPassDesc gather = describePass(
        ".gather", {spv::oit_stochastic_gather_media_frag, spv::oit_stochastic_gather_surface_frag,
                    spv::oit_stochastic_gather_solid_frag});
    gather.specialization = store.specialization;
    gather.colors.assign(mIsColoured ? 2 : 1, {kFormat, gpu::Blend::additive()});
    for (std::uint32_t i = 0; i < shader::kMaxSampleImages; ++i)
        gather.bindings.push_back({shader::kBindingSamples + i, gpu::BindingType::SampledImage});
    mGather = LayerPass(device, inputs, gather);
}

/// Images of the passes that follow the layers.
std::vector<gpu::Binding> sampled(std::initializer_list<std::uint32_t> numbers) {
    std::vector<gpu::Binding> bindings;
    for (const std::uint32_t number : numbers)
        bindings.push_back({number, gpu::BindingType::SampledImage});
    return bindings;
}

void Stochastic::makeAdaptivePasses(gpu::Device& device) {
    gpu::GraphicsPipelineDesc collect{
        .name = "oit.stochastic.collect",
        .vertexSpirv = spv::common_screen_vert,
        .fragmentSpirv = spv::oit_stochastic_collect_frag,
        .bindings = sampled({shader::kBindingOpaqueColor, shader::kBindingStochasticTotal,
                             shader::kBindingStochasticSum, shader::kBindingStochasticWeights}),
        .specialization = mEstimateConstants,
        .colors = {},
        .depthFormat = kMaskFormat,
        .depthTest = true};
    collect.colors.assign(mIsColoured ? 4 : 3, {kFormat, gpu::Blend::additive()});
    mCollect = gpu::GraphicsPipeline(device, collect);
    mStop = gpu::GraphicsPipeline(
        device, {.name = "oit.stochastic.stop",
                 .vertexSpirv = spv::common_screen_vert,
                 .fragmentSpirv = spv::oit_stochastic_stop_frag,
                 .bindings = sampled({shader::kBindingStochasticMeans,
                                      shader::kBindingStochasticSquares}),
                 .specialization = mEstimateConstants,
                 .depthFormat = kMaskFormat,
                 .depthTest = true,
                 .depthWrite = true});
    const auto makeCounters = [&](const char* name, gpu::MemoryKind memory) {
        return gpu::Buffer(device, {.name = std::string("oit.stochastic.") + name,
                                    .bytes = sizeof(shader::StochasticCounters),
                                    .memory = memory});
    };
    mCounters = makeCounters("counters", gpu::MemoryKind::Device);
    mCountersRead = makeCounters("counters_read", gpu::MemoryKind::Readback);
}

void Stochastic::makeResolves(gpu::Device& device) {
    std::vector<gpu::Binding> bindings =
        sampled({shader::kBindingStochasticTotal, shader::kBindingStochasticSum,
                 shader::kBindingStochasticWeights, shader::kBindingStochasticMeans,
                 shader::kBindingStochasticSquares});
    mResolve =
        makeResolve(device, "oit.stochastic.resolve", spv::oit_stochastic_resolve_frag, bindings,
                    mEstimateConstants, sizeof(shader::StochasticResolvePush), skipsUntouched());
    if (mSettings.filter > 0)
        mFilter = makeResolve(
            device, "oit.stochastic.filter", spv::oit_stochastic_filter_frag,
            sampled({shader::kBindingStochasticTotal, shader::kBindingStochasticLayers}),
            mEstimateConstants);
}

Targets Stochastic::makeTargets(frame::FrameBuilder& frame, const Inputs& inputs) const {
    const auto make = [&](const char* name, VkFormat format = kFormat) {
        return makeLayerTarget(frame, inputs, std::string("oit.stochastic.") + name, format);
    };
    Targets targets{make("total"), make("sum"), {}, {}, {}};
    if (skipsUntouched()) targets.touched = make("touched", kTouchedFormat);
    if (mIsColoured) targets.weights = make("weights");
    if (!mSettings.isAdaptive()) return targets;
    targets.all = {make("means"), make("squares"), make("sum_of_all"), {},
                   make("mask", kMaskFormat)};
    if (mIsColoured) targets.all.weights = make("weights_of_all");
    frame.addPass("oit.stochastic.open")
        .depth(targets.all.mask, gpu::LoadOp::Clear)
        .record([](gpu::Commands&, const frame::PassResources&) {});
    return targets;
}

std::vector<frame::ImageRef> Stochastic::declareStore(frame::FrameBuilder& frame,
                                                      const Inputs& inputs,
                                                      const SolidTargets& solids,
                                                      const Targets& targets,
                                                      std::uint32_t step) const {
    std::vector<frame::ImageRef> samples;
    frame::PassBuilder& store = frame.addPass("oit.stochastic.store");
    LayerPass::declareReads(store, inputs, solids);
    store.color(targets.total, step == 0 ? gpu::LoadOp::Clear : gpu::LoadOp::Load);
    for (std::uint32_t i = 0; i < imageCount(); ++i) {
        samples.push_back(makeLayerTarget(frame, inputs, "oit.stochastic.samples", kFormat));
        const float far = shader::kNoSample;
        store.color(samples.back(), gpu::LoadOp::Clear, {far, far, far, far});
    }
    if (targets.all.mask) store.depthTest(targets.all.mask);
    if (targets.touched && step == 0) store.depth(targets.touched, gpu::LoadOp::Clear);
    store.record([this, inputs, solids, step](gpu::Commands& commands,
                                              const frame::PassResources& resources) {
        (step == 0 ? mStore : mStoreMore)
            .record(commands, resources, inputs, solids, {.step = step});
    });
    return samples;
}

void Stochastic::declareGather(frame::FrameBuilder& frame, const Inputs& inputs,
                               const SolidTargets& solids, const Targets& targets,
                               const std::vector<frame::ImageRef>& samples,
                               std::uint32_t step) const {
    const bool isFirst = step == 0 || mSettings.isAdaptive();
    frame::PassBuilder& gather = frame.addPass("oit.stochastic.gather");
    LayerPass::declareReads(gather, inputs, solids);
    for (const frame::ImageRef image : samples) gather.reads(image, Access::FragmentSample);
    for (const frame::ImageRef sum : {targets.sum, targets.weights})
        if (sum) gather.color(sum, isFirst ? gpu::LoadOp::Clear : gpu::LoadOp::Load);
    if (targets.all.mask) gather.depthTest(targets.all.mask);
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

/// Declares and records a triangle over the screen that reads these images.
void declareScreen(frame::PassBuilder& pass, const Inputs& inputs,
                   const gpu::GraphicsPipeline& pipeline,
                   const std::vector<std::pair<std::uint32_t, frame::ImageRef>>& images) {
    for (const auto& [binding, image] : images) pass.reads(image, Access::FragmentSample);
    pass.record([inputs, images, &pipeline](gpu::Commands& commands,
                                            const frame::PassResources& resources) {
        commands.bindGraphics(pipeline);
        for (const auto& [binding, image] : images)
            commands.bind(binding, resources.image(image), *inputs.texelSampler);
        commands.draw(3);
    });
}

void Stochastic::declareCollect(frame::FrameBuilder& frame, const Inputs& inputs,
                                const Targets& targets, std::uint32_t step) const {
    const gpu::LoadOp load = step == 0 ? gpu::LoadOp::Clear : gpu::LoadOp::Load;
    const AdaptiveTargets& all = targets.all;
    frame::PassBuilder& pass = frame.addPass("oit.stochastic.collect");
    for (const frame::ImageRef target : {all.means, all.squares, all.sum, all.weights})
        if (target) pass.color(target, load);
    pass.depthTest(all.mask);
    declareScreen(pass, inputs, mCollect,
                  {{shader::kBindingOpaqueColor, inputs.opaqueColor},
                   {shader::kBindingStochasticTotal, targets.total},
                   {shader::kBindingStochasticSum, targets.sum},
                   {shader::kBindingStochasticWeights,
                    targets.weights ? targets.weights : targets.sum}});
}

void Stochastic::declareStop(frame::FrameBuilder& frame, const Inputs& inputs,
                             const Targets& targets) const {
    frame::PassBuilder& pass = frame.addPass("oit.stochastic.stop");
    pass.depth(targets.all.mask, gpu::LoadOp::Load);
    declareScreen(pass, inputs, mStop,
                  {{shader::kBindingStochasticMeans, targets.all.means},
                   {shader::kBindingStochasticSquares, targets.all.squares}});
}

void Stochastic::declareResolves(frame::FrameBuilder& frame, const Inputs& inputs,
                                 const Targets& targets) const {
    const bool isAdaptive = mSettings.isAdaptive(), isFiltered = mSettings.filter > 0;
    // Bindings that the specialised shader does not read get any image.
    const frame::ImageRef sum = isAdaptive ? targets.all.sum : targets.sum;
    const frame::ImageRef weights = isAdaptive ? targets.all.weights : targets.weights;
    const VkDeviceAddress counters = isAdaptive ? mCounters.deviceAddress() : 0;
    Inputs shown = inputs;
    if (isFiltered) shown.result = makeLayerTarget(frame, inputs, "oit.stochastic.layers", kFormat);
    if (isAdaptive) {
        frame.addPass("oit.stochastic.clear_counters")
            .writes(frame.importBuffer(mCounters), Access::TransferWrite)
            .record([this](gpu::Commands& commands, const frame::PassResources&) {
                commands.fillBuffer(mCounters, 0);
            });
    }
    frame::PassBuilder& resolve = declareResolve(
        frame, shown, "oit.stochastic.resolve", mResolve,
        {{shader::kBindingStochasticTotal, targets.total},
         {shader::kBindingStochasticSum, sum},
         {shader::kBindingStochasticWeights, weights ? weights : sum},
         {shader::kBindingStochasticMeans, isAdaptive ? targets.all.means : sum},
         {shader::kBindingStochasticSquares, isAdaptive ? targets.all.squares : sum}},
        [counters](gpu::Commands& commands) {
            commands.pushConstants(shader::StochasticResolvePush{counters});
        },
        targets.touched);
    if (isAdaptive) {
        resolve.readsWrites(frame.importBuffer(mCounters), Access::FragmentWrite);
        frame.addReadback("oit.stochastic.counters_read", frame.importBuffer(mCounters),
                          mCountersRead);
    }
    if (isFiltered)
        declareResolve(frame, inputs, "oit.stochastic.filter", mFilter,
                       {{shader::kBindingStochasticTotal, targets.total},
                        {shader::kBindingStochasticLayers, shown.result}});
}

void Stochastic::declare(frame::FrameBuilder& frame, const Inputs& inputs) {
    const SolidTargets solids = mSolids.declare(frame, inputs);
    const Targets targets = makeTargets(frame, inputs);
    for (std::uint32_t step = 0; step < mPassCount; ++step) {
        const auto samples = declareStore(frame, inputs, solids, targets, step);
        declareGather(frame, inputs, solids, targets, samples, step);
        if (!mSettings.isAdaptive()) continue;
        declareCollect(frame, inputs, targets, step);
        if (step > 0 && step + 1 < mPassCount) declareStop(frame, inputs, targets);
    }
    declareResolves(frame, inputs, targets);
}

std::map<std::string, std::uint64_t> Stochastic::counters() {
    if (!mSettings.isAdaptive()) return {{"samplePasses", mPassCount}};
    const auto counted = mCountersRead.mappedAs<shader::StochasticCounters>()[0];
    return {{"samplePasses", mPassCount},
            {"samplesTaken", std::uint64_t{counted.passes} * samplesPerPass()},
            {"pixelsAboveError", counted.unended}};
}

}  // namespace

const MethodInfo& Stochastic::info() const { return stochastic::info(); }

std::unique_ptr<OitMethod> create(gpu::Device& device, const Inputs& inputs,
                                  const scene::Settings& settings) {
    return std::make_unique<Stochastic>(device, inputs, readSettings(settings));
}

}  // namespace brume::oit::stochastic
