// SPDX-License-Identifier: Apache-2.0
// What: order-independent transparency from moments of the optical depth over the distance: they
//       tell how much lies in front of each layer.
// Source: C. Muenstermann, S. Krumpen, R. Klein, C. Peters: "Moment-Based Order-Independent
//         Transparency", Proc. ACM Comput. Graph. Interact. Tech. 1(1), 2018, DOI 10.1145/3203206.
// Equations: the moment problem -> distribution.glsl; warped depth -> placeOf().
// Differs: the range of distances is found for each pixel by a pass of its own; a medium adds its
//         whole interval; roots are bracketed by those of the derivatives, for any number of
//         moments; moments are biased towards those of the arcsine distribution; where all depth
//         lies at one place there is a branch of its own (the Hankel matrix has rank one).
// Limits: stacks of discrete layers are smoothed; media of optical depths above ten or so come out
// too dark (the correction of their sum is bounded); overlapping media are ordered by their middles.
// Cost: three raster passes, one resolve; bytes per pixel as info() says.
#include <oit/layers.hpp>
#include <oit/oit_method.hpp>

#include <shaders/oit/moment/moment.h>
#include <spv/oit/moment/gather_media.frag.hpp>
#include <spv/oit/moment/gather_solid.frag.hpp>
#include <spv/oit/moment/gather_surface.frag.hpp>
#include <spv/oit/moment/range_media.frag.hpp>
#include <spv/oit/moment/range_solid.frag.hpp>
#include <spv/oit/moment/range_surface.frag.hpp>
#include <spv/oit/moment/resolve.frag.hpp>
#include <spv/oit/moment/store_media.frag.hpp>
#include <spv/oit/moment/store_solid.frag.hpp>
#include <spv/oit/moment/store_surface.frag.hpp>

#include <bit>

namespace brume::oit::moment {
namespace {

using frame::Access;

struct Settings {
    std::uint32_t moments = 4;
    bool isHalf = false;

    /// What rounding of the stored moments may take them out of the valid ones by; chosen by us:
    /// moment_test finds no share outside [0, 1] by more than rounding.
    float bias() const {
        const float single = moments == 4 ? 6e-5f : moments == 6 ? 3e-4f : 1e-3f;
        return isHalf ? 50 * single : single;
    }
    VkFormat format() const {
        return isHalf ? VK_FORMAT_R16G16B16A16_SFLOAT : VK_FORMAT_R32G32B32A32_SFLOAT;
    }
};

constexpr VkFormat kSums = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat kRange = VK_FORMAT_R32G32_SFLOAT;

struct Targets {
    frame::ImageRef range, total, low, high, sum, touched;
};

class Moment final : public OitMethod {
  public:
    Moment(gpu::Device& device, const Inputs& inputs, const Settings& settings);

    const MethodInfo& info() const override;
    void prepare(const MeasureFunction&) override {}
    void declare(frame::FrameBuilder& frame, const Inputs& inputs) override;
    std::map<std::string, std::uint64_t> counters() override { return {}; }
    std::map<std::string, std::uint64_t> bytes() const override { return {}; }

  private:
    Targets makeTargets(frame::FrameBuilder& frame, const Inputs& inputs) const;
    void declareLayers(const Inputs& inputs,
                       const SolidTargets& solids, const Targets& targets, const LayerPass& layers,
                       frame::PassBuilder& pass, std::uint32_t imageCount) const;

    Settings mSettings;
    Solids mSolids;
    LayerPass mRange, mStore, mGather;
    gpu::GraphicsPipeline mResolve;
};

std::vector<gpu::Binding> sampled(std::uint32_t first, std::uint32_t count) {
    std::vector<gpu::Binding> bindings;
    for (std::uint32_t i = 0; i < count; ++i)
        bindings.push_back({first + i, gpu::BindingType::SampledImage});
    return bindings;
}

Moment::Moment(gpu::Device& device, const Inputs& inputs, const Settings& settings)
    : mSettings(settings), mSolids(device, "oit.moment", inputs) {
    gpu::Blend farthest = gpu::Blend::additive();
    farthest.colorOp = farthest.alphaOp = VK_BLEND_OP_MAX;
    const std::vector<std::uint32_t> constants = {
        settings.moments, std::bit_cast<std::uint32_t>(settings.bias())};
    std::vector<gpu::ColorTarget> sums = {{kSums, gpu::Blend::additive()},
                                          {settings.format(), gpu::Blend::additive()}};
    if (settings.moments > 4) sums.push_back(sums.back());
    mRange = LayerPass(device, inputs,
                       {.name = "oit.moment.range",
                        .shaders = {spv::oit_moment_range_media_frag,
                                    spv::oit_moment_range_surface_frag,
                                    spv::oit_moment_range_solid_frag},
                        .bindings = {},
                        .specialization = {},
                        .colors = {{kRange, farthest}},
                        .depthFormat = kTouchedFormat,
                        .depthUse = DepthUse::Mark});
    mStore = LayerPass(device, inputs,
                       {.name = "oit.moment.store",
                        .shaders = {spv::oit_moment_store_media_frag,
                                    spv::oit_moment_store_surface_frag,
                                    spv::oit_moment_store_solid_frag},
                        .bindings = sampled(shader::kBindingMomentRange, 1),
                        .specialization = constants,
                        .colors = sums});
    mGather = LayerPass(device, inputs,
                        {.name = "oit.moment.gather",
                         .shaders = {spv::oit_moment_gather_media_frag,
                                     spv::oit_moment_gather_surface_frag,
                                     spv::oit_moment_gather_solid_frag},
                         .bindings = sampled(shader::kBindingMomentRange, 4),
                         .specialization = constants,
                         .colors = {{kSums, gpu::Blend::additive()}}});
    mResolve = makeResolve(device, "oit.moment.resolve", spv::oit_moment_resolve_frag,
                           sampled(shader::kBindingMomentSum, 2), {}, 0, true);
}

Targets Moment::makeTargets(frame::FrameBuilder& frame, const Inputs& inputs) const {
    const auto make = [&](const char* name, VkFormat format) {
        return makeLayerTarget(frame, inputs, std::string("oit.moment.") + name, format);
    };
    Targets targets{make("range", kRange), make("total", kSums), make("low", mSettings.format()),
                    {}, make("sum", kSums), make("touched", kTouchedFormat)};
    if (mSettings.moments > 4) targets.high = make("high", mSettings.format());
    return targets;
}

void Moment::declareLayers(const Inputs& inputs, const SolidTargets& solids,
                           const Targets& targets, const LayerPass& layers,
                           frame::PassBuilder& pass, std::uint32_t imageCount) const {
    LayerPass::declareReads(pass, inputs, solids);
    // In the order of their bindings.
    const std::vector<frame::ImageRef> images = {
        targets.range, targets.total, targets.low, targets.high ? targets.high : targets.low};
    for (std::uint32_t i = 0; i < imageCount; ++i) pass.reads(images[i], Access::FragmentSample);
    const auto bind = [inputs, images, imageCount](gpu::Commands& commands,
                                                   const frame::PassResources& resources) {
        for (std::uint32_t i = 0; i < imageCount; ++i)
            commands.bind(shader::kBindingMomentRange + i, resources.image(images[i]),
                          *inputs.texelSampler);
    };
    pass.record([&layers, inputs, solids, bind](gpu::Commands& commands,
                                                const frame::PassResources& resources) {
        layers.record(commands, resources, inputs, solids, {.bind = bind});
    });
}

void Moment::declare(frame::FrameBuilder& frame, const Inputs& inputs) {
    const SolidTargets solids = mSolids.declare(frame, inputs);
    const Targets targets = makeTargets(frame, inputs);
    frame::PassBuilder& range = frame.addPass("oit.moment.range");
    range.color(targets.range, gpu::LoadOp::Clear, {-3e38f, 0, 0, 0})
        .depth(targets.touched, gpu::LoadOp::Clear);
    declareLayers(inputs, solids, targets, mRange, range, 0);

    frame::PassBuilder& store = frame.addPass("oit.moment.store");
    store.color(targets.total, gpu::LoadOp::Clear).color(targets.low, gpu::LoadOp::Clear);
    if (targets.high) store.color(targets.high, gpu::LoadOp::Clear);
    declareLayers(inputs, solids, targets, mStore, store, 1);

    frame::PassBuilder& gather = frame.addPass("oit.moment.gather");
    gather.color(targets.sum, gpu::LoadOp::Clear);
    declareLayers(inputs, solids, targets, mGather, gather, 4);

    declareResolve(frame, inputs, "oit.moment.resolve", mResolve,
                   {{shader::kBindingMomentSum, targets.sum},
                    {shader::kBindingMomentDepth, targets.total}},
                   {}, targets.touched);
}

}  // namespace

const MethodInfo& info() {
    static const MethodInfo kInfo{
        .name = "moment",
        .summary = "Moments of the optical depth tell how much lies in front of each layer.",
        .paper = "Muenstermann, Krumpen, Klein, Peters: Moment-Based Order-Independent "
                 "Transparency, 2018",
        .exactness = Exactness::Approximate,
        .passes = "3 raster + 1 resolve",
        .bytesPerPixel = "58; 74 with 6 or 8 moments; half: 50, 58",
        .limits = "stacks of discrete layers are smoothed; thick media come out too dark; overlapping media "
                  "are not mixed",
        .weaknesses = {Weakness::Order, Weakness::ManyLayers, Weakness::Overlap, Weakness::Surfaces,
                       Weakness::Thick, Weakness::Emission},
        .settings = {{"moments", "4, 6, 8", "4", "how many are kept"},
                     {"precision", "half, single", "single", "of the moments; ties the bias"}}};
    return kInfo;
}

const MethodInfo& Moment::info() const { return moment::info(); }

std::unique_ptr<OitMethod> create(gpu::Device& device, const Inputs& inputs,
                                  const scene::Settings& settings) {
    scene::SettingsReader reader(settings, "setting up method moment");
    Settings s;
    s.moments =
        static_cast<std::uint32_t>(std::stoul(reader.choice("moments", "4", {"4", "6", "8"})));
    s.isHalf = reader.choice("precision", "single", {"half", "single"}) == "half";
    reader.finish();
    return std::make_unique<Moment>(device, inputs, s);
}

}  // namespace brume::oit::moment
