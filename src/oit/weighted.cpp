// SPDX-License-Identifier: Apache-2.0
// What: order-independent transparency from sums: what all layers together let through is exact,
//       what they send is a mean of their radiances weighted by distance. One pass, no lists.
// Source: M. McGuire, M. Mara: "A Phenomenological Scattering Model for Order-Independent
//         Transparency", I3D 2016, DOI 10.1145/2856400.2856418.
// Equations: eq. 2 -> depthFromLoss() and resolve.frag; eq. 3, 4, 13 -> resolve.frag; eq. 5 ->
//         weightAt(); eq. 6, 7 -> blurOf(); eq. 8, 9 -> refractionOf(); section 5 -> background.glsl.
// Differs: beta is kept as a sum of -ln (listing 1 multiplies 8 bits, which lose faint layers, and
//         by a third, against eq. 2; `packed` has its 8 bits); the mean radiance is shared out by the mean of 1 - beta, so
//         that a single layer of any colour is exact; weights are a power of the view distance (eq.
//         5 takes gl_FragCoord.z, which depends on near and far); eq. 7 squares the reach twice, we
//         once; eq. 8 as Snell's law; offsets are averaged by coverage; a gathered pixel counts
//         within both blurs (section 5 states the reverse); listing 2's divisions by zero are
//         guarded; the gather takes a spiral of few taps instead of the whole disk.
// Limits: layers that overlap in depth get a mean, not an order: wrong where near layers hide far
//         ones of another radiance; diffusion and refraction see only the opaque background.
// Cost: one raster pass, one resolve; bytes per pixel as info() says.
#include <oit/layers.hpp>
#include <oit/oit_method.hpp>

#include <shaders/oit/weighted/weighted.h>
#include <spv/oit/weighted/media.frag.hpp>
#include <spv/oit/weighted/resolve.frag.hpp>
#include <spv/oit/weighted/solid.frag.hpp>
#include <spv/oit/weighted/surface.frag.hpp>

#include <bit>

namespace brume::oit::weighted {
namespace {

using frame::Access;

enum class Precision {
    Packed,   ///< the paper's: transmittance in 8 bits, no room to normalise offsets
    Half,    ///< 16-bit floats: faint layers beyond some hundred are lost
    Single,  ///< 32-bit floats
    Exact    ///< depths as two 32-bit sums: beta to 1e-6 after thousands of faint layers
};

struct Settings {
    Precision precision = Precision::Single;
    float depthPower = 2;
    float weightDistance = 5;    ///< m, where the weight is 1; matters for half precision only
    float selfModulation = 0;  ///< 0.5: eq. 13; off, because it tints single layers as well
    std::uint32_t lowResolution = 1;
    bool diffusion = true;
    bool refraction = false;
    float diffusionWidth = 0.1f;      ///< m, k0 of eq. 6
    float diffusionReach = 0.5f;      ///< m, k1 of eq. 7
    float refractionDistance = 2;     ///< m, delta z of eq. 9
    std::uint32_t diffusionTaps = 24;  ///< 0: every pixel of the disk
};

Settings readSettings(const scene::Settings& given) {
    scene::SettingsReader reader(given, "setting up method weighted");
    const auto number = [&](const char* key, float fallback, double lo, double hi) {
        return static_cast<float>(reader.number(key, fallback, lo, hi));
    };
    Settings s;
    const std::string precision = reader.choice("precision", "single", {"packed", "half", "single", "exact"});
    s.precision = precision == "packed"  ? Precision::Packed
                  : precision == "half"  ? Precision::Half
                  : precision == "exact" ? Precision::Exact
                                         : Precision::Single;
    s.depthPower = number("depthPower", s.depthPower, 0, 16);
    s.weightDistance = number("weightDistance", s.weightDistance, 1e-6, 1e6);
    s.selfModulation = number("selfModulation", s.selfModulation, 0, 1);
    s.lowResolution = readLowResolution(reader);
    s.diffusion = reader.boolean("diffusion", s.diffusion);
    s.refraction = reader.boolean("refraction", s.refraction);
    s.diffusionWidth = number("diffusionWidth", s.diffusionWidth, 1e-6, 1e3);
    s.diffusionReach = number("diffusionReach", s.diffusionReach, 1e-6, 1e6);
    s.refractionDistance = number("refractionDistance", s.refractionDistance, 1e-3, 1e6);
    s.diffusionTaps = static_cast<std::uint32_t>(reader.integer("diffusionTaps", 24, 0, 512));
    reader.finish();
    return s;
}

std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value); }

/// The images of one resolution.
struct Targets {
    frame::ImageRef sum, depth, fine, offset, touched;
};

class Weighted final : public OitMethod {
  public:
    Weighted(gpu::Device& device, const Inputs& inputs, const Settings& settings);

    const MethodInfo& info() const override;
    void prepare(const MeasureFunction&) override {}
    void declare(frame::FrameBuilder& frame, const Inputs& inputs) override;
    std::map<std::string, std::uint64_t> counters() override { return {}; }
    std::map<std::string, std::uint64_t> bytes() const override { return {}; }

  private:
    bool isPacked() const { return mSettings.precision == Precision::Packed; }
    VkFormat sumFormat() const;
    VkFormat depthFormat() const;
    VkFormat offsetFormat() const { return isPacked() ? mPackedOffset : sumFormat(); }
    gpu::Blend depthBlend() const;
    bool hasFine() const { return mIsColoured && mSettings.precision == Precision::Exact; }
    bool isLow() const { return mSettings.lowResolution > 1; }
    /// Not where every bit counts, nor where layers come from elsewhere too.
    bool marksTouched() const {
        return mSettings.precision >= Precision::Single && !isLow() && !mTakesHostLayers;
    }
    std::vector<gpu::ColorTarget> colors(bool withOffset) const;
    LayerPassDesc describePass(const char* suffix, std::uint32_t scale, bool withOffset) const;
    std::vector<gpu::Binding> resolveBindings() const;
    Targets makeTargets(frame::FrameBuilder& frame, const char* suffix, VkExtent2D extent,
                        bool withOffset) const;
    frame::PassBuilder& addStore(frame::FrameBuilder& frame, const char* name,
                                 const Targets& targets) const;
    void declareResolve(frame::FrameBuilder& frame, const Inputs& inputs, const Targets& full,
                        const Targets& low) const;

    Settings mSettings;
    VkFormat mPackedOffset;
    bool mTakesHostLayers, mIsColoured, mDiffuses, mRefracts;
    Solids mSolids;
    LayerPass mStore, mStoreLow;
    gpu::GraphicsPipeline mResolve;
};

Weighted::Weighted(gpu::Device& device, const Inputs& inputs, const Settings& settings)
    : mSettings(settings),
      // Not every device adds up signed bytes.
      mPackedOffset(device.canBlend(VK_FORMAT_R8G8_SNORM) ? VK_FORMAT_R8G8_SNORM
                                                          : VK_FORMAT_R16G16_SFLOAT),
      mTakesHostLayers(inputs.needs.hostLayers),
      mIsColoured(isColoured(inputs.needs) || mTakesHostLayers ||
                  (inputs.needs.diffusion && settings.diffusion)),
      mDiffuses(inputs.needs.diffusion && settings.diffusion),
      mRefracts(inputs.needs.surfaces && settings.refraction),
      mSolids(device, "oit.weighted", inputs) {
    Inputs seen = inputs;
    seen.needs.colouredSurfaces = mIsColoured;
    mStore = LayerPass(device, seen, describePass(".store", 1, mRefracts),
                       isLow() ? kLayersSurfaces : kLayersAll);
    if (isLow())
        mStoreLow = LayerPass(device, seen,
                              describePass(".store_low", mSettings.lowResolution, false),
                              kLayersMedia);
    mResolve = makeResolve(device, "oit.weighted.resolve", spv::oit_weighted_resolve_frag,
                           resolveBindings(),
                           {mIsColoured, mSettings.precision == Precision::Exact, mDiffuses,
                            mRefracts, bits(mSettings.selfModulation), mSettings.lowResolution,
                            mSettings.diffusionTaps, isPacked()},
                           0, marksTouched());
}

VkFormat Weighted::sumFormat() const {
    return mSettings.precision <= Precision::Half ? VK_FORMAT_R16G16B16A16_SFLOAT
                                                  : VK_FORMAT_R32G32B32A32_SFLOAT;
}

VkFormat Weighted::depthFormat() const {
    if (mIsColoured) return isPacked() ? VK_FORMAT_R8G8B8A8_UNORM : sumFormat();
    switch (mSettings.precision) {
        case Precision::Packed:
            return VK_FORMAT_R8_UNORM;
        case Precision::Half:
            return VK_FORMAT_R16_SFLOAT;
        case Precision::Single:
            return VK_FORMAT_R32_SFLOAT;
        case Precision::Exact:
            break;
    }
    return VK_FORMAT_R32G32_SFLOAT;
}

/// Depths and squared blurs add up; packed transmittances multiply.
gpu::Blend Weighted::depthBlend() const {
    gpu::Blend blend = gpu::Blend::additive();
    if (!isPacked()) return blend;
    blend.sourceColor = VK_BLEND_FACTOR_ZERO;
    blend.targetColor = VK_BLEND_FACTOR_SRC_COLOR;
    return blend;
}

std::vector<gpu::ColorTarget> Weighted::colors(bool withOffset) const {
    std::vector<gpu::ColorTarget> targets = {{sumFormat(), gpu::Blend::additive()},
                                             {depthFormat(), depthBlend()}};
    if (withOffset) targets.push_back({offsetFormat(), gpu::Blend::additive()});
    if (hasFine()) targets.push_back({sumFormat(), gpu::Blend::additive()});
    return targets;
}

LayerPassDesc Weighted::describePass(const char* suffix, std::uint32_t scale,
                                     bool withOffset) const {
    // 30 as in eq. 5: sums of 16-bit floats end at 65504.
    const float maxWeight = mSettings.precision <= Precision::Half ? 30.0f : 1e12f;
    return {.name = std::string("oit.weighted") + suffix,
            .shaders = {spv::oit_weighted_media_frag, spv::oit_weighted_surface_frag,
                        spv::oit_weighted_solid_frag},
            .bindings = {},
            .specialization = {mSettings.precision == Precision::Exact, bits(mSettings.depthPower),
                               bits(mSettings.weightDistance), bits(maxWeight), mDiffuses,
                               withOffset, bits(mSettings.diffusionWidth),
                               bits(mSettings.diffusionReach), bits(mSettings.refractionDistance),
                               isPacked()},
            .colors = colors(withOffset),
            .scale = scale,
            .drawsSolidFaces = withOffset,
            .depthFormat = marksTouched() ? kTouchedFormat : VK_FORMAT_UNDEFINED,
            .depthUse = DepthUse::Mark};
}

std::vector<gpu::Binding> Weighted::resolveBindings() const {
    std::vector<gpu::Binding> bindings;
    for (std::uint32_t i = shader::kBindingWeightedSum; i <= shader::kBindingWeightedLowFine; ++i)
        bindings.push_back({i, gpu::BindingType::SampledImage});
    return bindings;
}

Targets Weighted::makeTargets(frame::FrameBuilder& frame, const char* suffix, VkExtent2D extent,
                              bool withOffset) const {
    const auto make = [&](const char* name, VkFormat format) {
        return frame.createImage({.name = std::string("oit.weighted.") + name + suffix,
                                  .format = format,
                                  .width = extent.width,
                                  .height = extent.height,
                                  .usage = 0});
    };
    return {make("sum", sumFormat()), make("depth", depthFormat()),
            hasFine() ? make("fine", sumFormat()) : frame::ImageRef{},
            withOffset ? make("offset", offsetFormat()) : frame::ImageRef{},
            marksTouched() ? make("touched", kTouchedFormat) : frame::ImageRef{}};
}

frame::PassBuilder& Weighted::addStore(frame::FrameBuilder& frame, const char* name,
                                       const Targets& targets) const {
    frame::PassBuilder& pass = frame.addPass(name);
    const float one = isPacked() ? 1.0f : 0.0f;
    pass.color(targets.sum, gpu::LoadOp::Clear)
        .color(targets.depth, gpu::LoadOp::Clear, {one, one, one, 0});
    for (const frame::ImageRef target : {targets.offset, targets.fine})
        if (target) pass.color(target, gpu::LoadOp::Clear);
    if (targets.touched) pass.depth(targets.touched, gpu::LoadOp::Clear);
    return pass;
}

void Weighted::declareResolve(frame::FrameBuilder& frame, const Inputs& inputs,
                              const Targets& full, const Targets& low) const {
    // Bindings that the specialised shader does not read get any image.
    oit::declareResolve(frame, inputs, "oit.weighted.resolve", mResolve,
                        {{shader::kBindingWeightedSum, full.sum},
                         {shader::kBindingWeightedDepth, full.depth},
                         {shader::kBindingWeightedFine, full.fine ? full.fine : full.sum},
                         {shader::kBindingWeightedOffset, full.offset ? full.offset : full.sum},
                         {shader::kBindingWeightedLowSum, isLow() ? low.sum : full.sum},
                         {shader::kBindingWeightedLowDepth, isLow() ? low.depth : full.sum},
                         {shader::kBindingWeightedLowFine, low.fine ? low.fine : full.sum}},
                        {}, full.touched);
}

void Weighted::declare(frame::FrameBuilder& frame, const Inputs& inputs) {
    const SolidTargets solids = mSolids.declare(frame, inputs);
    const auto addPass = [&](const char* name, const Targets& targets, const LayerPass& layers) {
        frame::PassBuilder& pass = addStore(frame, name, targets);
        LayerPass::declareReads(pass, inputs, solids);
        pass.record([&layers, inputs, solids](gpu::Commands& commands,
                                              const frame::PassResources& resources) {
            layers.record(commands, resources, inputs, solids);
        });
    };
    const Targets full = makeTargets(frame, "", inputs.extent, mRefracts);
    addPass("oit.weighted.store", full, mStore);
    if (mTakesHostLayers)
        frame.addPass("oit.weighted.host_layers")
            .color(full.sum, gpu::LoadOp::Load)
            .color(full.depth, gpu::LoadOp::Load)
            .handOver();
    Targets low;
    if (isLow()) {
        low = makeTargets(frame, "_low", lowExtent(inputs, mSettings.lowResolution), false);
        addPass("oit.weighted.store_low", low, mStoreLow);
    }
    declareResolve(frame, inputs, full, low);
}

}  // namespace

const MethodInfo& info() {
    static const MethodInfo kInfo{
        .name = "weighted",
        .summary = "Sums: exact transmittance of all layers, radiance as a mean weighted by "
                   "distance; blur and refraction of the background.",
        .paper = "McGuire, Mara: A Phenomenological Scattering Model for Order-Independent "
                 "Transparency, 2016",
        .exactness = Exactness::Approximate,
        .passes = "1 raster + 1 resolve",
        .bytesPerPixel = "22; 34 with colours or diffusion; 16 more with refraction; half: 10, 16, "
                         "8; exact: 26, 50, 16; packed: 9, 12, 2 (4 where signed bytes do not "
                         "blend)",
        .limits = "near layers do not hide far ones of another radiance as they should; overlapping "
                  "media are not mixed",
        .weaknesses = {Weakness::Order, Weakness::ManyLayers, Weakness::Overlap, Weakness::Surfaces,
                       Weakness::Emission},
        .settings = {
            {"precision", "packed, half, single, exact", "single",
             "of the sums; packed: the formats of the paper; exact keeps thousands of faint layers "
             "to 1e-6"},
            {"depthPower", "0..16", "2", "weight = (weightDistance / distance)^depthPower"},
            {"weightDistance", "1e-6..1e6 m", "5", "where the weight is 1; matters for half"},
            {"selfModulation", "0..1", "0", "how far layers take the hue of the transmittance; 0.5 in the paper"},
            kLowResolution,
            {"diffusion", "true, false", "true", "surfaces with collimation < 1 blur what is behind"},
            {"refraction", "true, false", "false", "surfaces displace what is behind"},
            {"diffusionWidth", "1e-6..1e3 m", "0.1", "blur at distance 1 by collimation 0"},
            {"diffusionReach", "1e-6..1e6 m", "0.5", "gap behind a surface that blurs by half"},
            {"refractionDistance", "1e-3..1e6 m", "2", "of the background behind a surface"},
            {"diffusionTaps", "0..512", "24", "of the gather; 0: every pixel of the disk"}}};
    return kInfo;
}

const MethodInfo& Weighted::info() const { return weighted::info(); }

std::unique_ptr<OitMethod> create(gpu::Device& device, const Inputs& inputs,
                                  const scene::Settings& settings) {
    return std::make_unique<Weighted>(device, inputs, readSettings(settings));
}

}  // namespace brume::oit::weighted
