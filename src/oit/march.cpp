// SPDX-License-Identifier: Apache-2.0
// What: media marched along each ray at fixed steps, empty bricks left out, up to the transmittance at
//       which nothing more is seen: what engines do for volumes. The baseline for `tile`, and a fast
//       preview of fields whose detail is larger than a step.
// Source: M. Levoy: "Efficient Ray Tracing of Volume Data", ACM TOG 9(3), 1990,
//         doi:10.1145/78964.78965 (skipping what is empty, early termination).
// Differs: steps are a medium's own: of a volume in voxels, of a sphere in eighths of its radius; a step
//          attenuates by its exact share of light for constant density.
// Limits: density and light are those of the middle of each step; media that overlap follow each other
//         as wholes and are not mixed; surfaces are blended behind all media, in the order of
//         submission. Not measured by a bound.
// Cost: 4 bytes per pair of tile and medium, nothing per pixel (40 bytes with solids); one density and
//       one look at each light per step.
#include <oit/bindings.hpp>
#include <oit/layers.hpp>
#include <oit/media_bins.hpp>
#include <oit/oit_method.hpp>

#include <shaders/common/frame.h>
#include <shaders/common/frame_bindings.h>
#include <shaders/oit/march/march.h>
#include <spv/oit/march/march.comp.hpp>

namespace brume::oit::march {
namespace {

using frame::Access;

struct Settings {
    float step = 0.5f;           ///< voxels; of spheres: eighths of the radius
    float epsilon = 1.f / 1024;  ///< transmittance at which a pixel stops; 0: never
};

class March final : public OitMethod {
  public:
    March(gpu::Device& device, const Inputs& inputs, const Settings& settings);

    const MethodInfo& info() const override;
    void prepare(const MeasureFunction& measure) override;
    void declare(frame::FrameBuilder& frame, const Inputs& inputs) override;
    std::map<std::string, std::uint64_t> counters() override;
    bool lacksMemory() override { return mHasMedia && mBins.droppedPairs() > 0; }
    std::map<std::string, std::uint64_t> bytes() const override {
        return {{"pairs", mBins.pairBytes()}, {"bins", mBins.bytes() - mBins.pairBytes()}};
    }

  private:
    void record(gpu::Commands& commands, const frame::PassResources& resources,
                const Inputs& inputs) const;

    Settings mSettings;
    bool mHasMedia;
    std::uint32_t mTileCount;
    MediaBins mBins;
    OverLayers mSurfaces;
    gpu::ComputePipeline mMarch;
    gpu::Buffer mCounters, mCountersRead;
};

/// The surfaces alone.
Inputs withoutMedia(Inputs inputs) {
    inputs.needs.spheres = inputs.needs.boxes = false;
    return inputs;
}

March::March(gpu::Device& device, const Inputs& inputs, const Settings& settings)
    : mSettings(settings),
      mHasMedia(inputs.needs.spheres || inputs.needs.boxes),
      mTileCount(countTiles(inputs.extent)),
      mBins(device, "oit.march", inputs, true),
      mSurfaces(device, "oit.march", withoutMedia(inputs), 1),
      mMarch(device,
             {.name = "oit.march.march",
              .spirv = spv::oit_march_march_comp,
              .bindings = join(join(frameBindings(), mediaBindings()),
                               {{shader::kBindingOpaqueT, gpu::BindingType::SampledImage},
                                {shader::kBindingMarchResult, gpu::BindingType::StorageImage}}),
              .pushConstantBytes = sizeof(shader::MarchPush),
              .specialization = {inputs.needs.colouredExtinction, inputs.needs.boxes,
                                 inputs.needs.spheres},
              .constants = lightingConstants(inputs.needs)}),
      mCounters(device,
                {.name = "oit.march.counters", .bytes = sizeof(shader::MarchCounters)}),
      mCountersRead(device, {.name = "oit.march.counters_read",
                             .bytes = sizeof(shader::MarchCounters),
                             .memory = gpu::MemoryKind::Readback}) {}

void March::prepare(const MeasureFunction& measure) {
    if (!measure) return mBins.reserve(std::uint64_t{mTileCount} * kReservedPairsPerTile);
    measure([this](frame::FrameBuilder& frame, const Inputs& inputs) {
        mBins.declareCount(frame, inputs);
    });
    mBins.allocate();
}

void March::declare(frame::FrameBuilder& frame, const Inputs& inputs) {
    mSurfaces.declare(frame, withoutMedia(inputs), {});
    if (!mHasMedia) return;
    mBins.declareCount(frame, inputs);
    mBins.declareScatter(frame, inputs);
    const frame::BufferRef counters = frame.importBuffer(mCounters);
    frame.addPass("oit.march.clear_counters")
        .writes(counters, Access::TransferWrite)
        .record([this](gpu::Commands& commands, const frame::PassResources&) {
            commands.fillBuffer(mCounters, 0);
        });
    frame::PassBuilder& pass = frame.addPass("oit.march.march");
    mBins.declareReads(frame, pass);
    pass.reads(inputs.opaqueT, Access::ComputeSample)
        .readsWrites(counters, Access::ComputeWrite)
        .readsWrites(inputs.result, Access::ComputeWrite)
        .record([this, inputs](gpu::Commands& commands, const frame::PassResources& resources) {
            record(commands, resources, inputs);
        });
    frame.addReadback("oit.march.counters_read", counters, mCountersRead);
}

void March::record(gpu::Commands& commands, const frame::PassResources& resources,
                   const Inputs& inputs) const {
    commands.bindCompute(mMarch);
    bindFrame(commands, inputs);
    bindMedia(commands, inputs, mBins.sortedSpheres(), mBins.listedBoxes(inputs));
    commands.bind(shader::kBindingOpaqueT, resources.image(inputs.opaqueT), *inputs.texelSampler);
    commands.bind(shader::kBindingMarchResult, resources.image(inputs.result));
    commands.pushConstants(shader::MarchPush{.sphereOffsets = mBins.spheres().offsets,
                                             .spherePairs = mBins.spheres().pairs,
                                             .boxOffsets = mBins.boxes().offsets,
                                             .boxPairs = mBins.boxes().pairs,
                                             .counters = mCounters.deviceAddress(),
                                             .step = mSettings.step,
                                             .epsilon = mSettings.epsilon});
    const auto countOf = [](std::uint32_t pixels) {
        return (pixels + shader::kTileSize - 1) / shader::kTileSize;
    };
    commands.dispatch(countOf(inputs.extent.width), countOf(inputs.extent.height));
}

std::map<std::string, std::uint64_t> March::counters() {
    if (!mHasMedia) return {{"dropped", 0}, {"exhausted", 0}};
    const auto own = mCountersRead.mappedAs<shader::MarchCounters>()[0];
    return {{"dropped", mBins.droppedPairs()},
            {"exhausted", own.exhausted},
            {"pairs", mBins.pairCount()},
            {"steps", own.steps}};
}

}  // namespace

const MethodInfo& info() {
    static const MethodInfo kInfo{
        .name = "march",
        .summary = "Media marched at fixed steps, empty bricks left out; what engines do.",
        .paper = "Levoy: Efficient Ray Tracing of Volume Data, 1990",
        .exactness = Exactness::Approximate,
        .passes = "1 sort + 1 compute, 1 raster with surfaces",
        .bytesPerPixel = "0 (4 per pair of tile and medium; 40 with solids)",
        .limits = "density and light are constant along a step; overlapping media are not mixed; "
                  "surfaces are behind all media",
        .weaknesses = {Weakness::Order, Weakness::ManyLayers, Weakness::Overlap,
                       Weakness::Surfaces, Weakness::Colour, Weakness::Profile},
        .settings = {{"step", "0.05 .. 64 voxels", "0.5",
                      "length of a step; of spheres in eighths of the radius"},
                     {"epsilon", "0 .. 0.5", "0.0009765625",
                      "transmittance at which a pixel stops; 0: never"}}};
    return kInfo;
}

const MethodInfo& March::info() const { return march::info(); }

std::unique_ptr<OitMethod> create(gpu::Device& device, const Inputs& inputs,
                                  const scene::Settings& settings) {
    scene::SettingsReader reader(settings, "setting up method march");
    Settings values;
    values.step = static_cast<float>(reader.number("step", values.step, 0.05, 64));
    values.epsilon = static_cast<float>(reader.number("epsilon", values.epsilon, 0, 0.5));
    reader.finish();
    return std::make_unique<March>(device, inputs, values);
}

}  // namespace brume::oit::march
