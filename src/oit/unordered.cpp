// SPDX-License-Identifier: Apache-2.0
// What: media and surfaces blended with "over" in the order of submission: the baseline that costs
//       one pass and is right only where nothing overlaps on the screen.
// Source: T. Porter, T. Duff: "Compositing Digital Images", SIGGRAPH 1984 (the operator).
// Limits: order, overlap and coloured transmission (blended by its mean) are ignored.
// Cost: nothing beyond the image; one raster pass, one more and 40 bytes per pixel with solids.
#include <oit/layers.hpp>
#include <oit/oit_method.hpp>

namespace brume::oit::unordered {
namespace {

class Unordered final : public OitMethod {
  public:
    Unordered(gpu::Device& device, const Inputs& inputs, std::uint32_t lowResolution)
        : mLayers(device, "oit.unordered", inputs, lowResolution) {}

    const MethodInfo& info() const override;
    void prepare(const MeasureFunction&) override {}
    void declare(frame::FrameBuilder& frame, const Inputs& inputs) override {
        mLayers.declare(frame, inputs, {});
    }
    std::map<std::string, std::uint64_t> counters() override { return {}; }
    std::map<std::string, std::uint64_t> bytes() const override { return {}; }

  private:
    OverLayers mLayers;
};

}  // namespace

const MethodInfo& info() {
    static const MethodInfo kInfo{
        .name = "unordered",
        .summary = "Billboards blended in the order of submission; the fastest wrong answer.",
        .paper = "Porter, Duff: Compositing Digital Images, 1984",
        .exactness = Exactness::Approximate,
        .passes = "1 raster",
        .bytesPerPixel = "0 (40 with solids; lowResolution n: 16 / n^2)",
        .limits = "ignores order, overlap and colour of transmission",
        .weaknesses = {Weakness::Order, Weakness::ManyLayers, Weakness::Overlap, Weakness::Surfaces,
                       Weakness::Colour},
        .settings = {kLowResolution}};
    return kInfo;
}

const MethodInfo& Unordered::info() const { return unordered::info(); }

std::unique_ptr<OitMethod> create(gpu::Device& device, const Inputs& inputs,
                                  const scene::Settings& settings) {
    scene::SettingsReader reader(settings, "setting up method unordered");
    const std::uint32_t lowResolution = readLowResolution(reader);
    reader.finish();
    return std::make_unique<Unordered>(device, inputs, lowResolution);
}

}  // namespace brume::oit::unordered
