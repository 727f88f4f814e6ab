// SPDX-License-Identifier: Apache-2.0
// What: media and surfaces blended with "over" in the order of submission: the baseline that costs
//       one pass and is right only where nothing overlaps on the screen.
// Source: T. Porter, T. Duff: "Compositing Digital Images", SIGGRAPH 1984 (the operator).
// Limits: order, overlap and coloured transmission (blended by its mean) are ignored; solids are
// not drawn. Cost: nothing beyond the image; one raster pass.
#include <oit/billboards.hpp>
#include <oit/oit_method.hpp>

namespace brume::oit::unordered {
namespace {

class Unordered final : public OitMethod {
  public:
    Unordered(gpu::Device& device, const Inputs& inputs)
        : mBillboards(device, "unordered", inputs) {}

    const MethodInfo& info() const override;
    void prepare(const MeasureFunction&) override {}
    void declare(frame::FrameBuilder& frame, const Inputs& inputs) override {
        mBillboards.declare(frame, inputs, {});
    }
    std::map<std::string, std::uint64_t> counters() override { return {}; }
    std::map<std::string, std::uint64_t> bytes() const override { return {}; }

  private:
    Billboards mBillboards;
};

}  // namespace

const MethodInfo& info() {
    static const MethodInfo kInfo{
        .name = "unordered",
        .summary = "Billboards blended in the order of submission; the fastest wrong answer.",
        .paper = "Porter, Duff: Compositing Digital Images, 1984",
        .exactness = Exactness::Approximate,
        .passes = "1 raster",
        .bytesPerPixel = "0",
        .limits = "ignores order, overlap and colour of transmission; does not draw solids",
        .settings = {}};
    return kInfo;
}

const MethodInfo& Unordered::info() const { return unordered::info(); }

std::unique_ptr<OitMethod> create(gpu::Device& device, const Inputs& inputs,
                                  const scene::Settings& settings) {
    scene::SettingsReader(settings, "setting up method unordered").finish();
    return std::make_unique<Unordered>(device, inputs);
}

}  // namespace brume::oit::unordered
