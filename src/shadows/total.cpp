// SPDX-License-Identifier: Apache-2.0
// What:   the product of all transmittances along each texel's ray, bilinear between texels.
// Source: M. McGuire, E. Enderton: "Colored stochastic shadow maps", I3D 2011, section 3.
// Limits: what stands between two casters gets the shadow of both.
// Cost:   4 bytes per texel and channel.
#include <shadows/map_pass.hpp>
#include <shadows/total.hpp>

#include <spv/shadows/total/build.comp.hpp>

namespace brume::shadows {

TotalMap::TotalMap(gpu::Device& device)
    : mDevice(&device),
      mBuild(makeMapPipeline(device, "shadow.total.build", spv::shadows_total_build_comp)) {}

void TotalMap::allocate(shader::ShadowMap& map) {
    mTotals = {*mDevice,
               {.name = "shadow.total.totals", .bytes = 4 * map.channels * texelCount(map)}};
    map.totals = mTotals.deviceAddress();
}

void TotalMap::declare(frame::FrameBuilder& frame, const MapBuild& build) const {
    declareWalk(frame, "shadow.total.build", build, mBuild, mTotals, 0);
}

namespace total {
namespace {

class Total final : public ShadowStore {
  public:
    explicit Total(gpu::Device& device) : mMap(device) {}
    const StoreInfo& info() const override;
    void allocate(shader::ShadowMap& map) override { mMap.allocate(map); }
    void declare(frame::FrameBuilder& frame, const MapBuild& build) const override {
        mMap.declare(frame, build);
    }
    std::uint64_t bytes() const override { return mMap.bytes(); }

  private:
    TotalMap mMap;
};

}  // namespace

const StoreInfo& info() {
    static const StoreInfo kInfo{
        .name = "total",
        .summary = "Total transmittance along the light ray, whatever the order.",
        .paper = "McGuire, Enderton: Colored Stochastic Shadow Maps, 2011",
        .result = "exact behind everything",
        .bytesPerTexel = "4 per channel",
        .limits = "inside and between casters it is the shadow of all of them",
        .bit = shader::kStoreTotal,
        .settings = {}};
    return kInfo;
}

const StoreInfo& Total::info() const { return total::info(); }

std::unique_ptr<ShadowStore> create(gpu::Device& device, const StoreRequest&,
                                    const scene::Settings& settings) {
    scene::SettingsReader(settings, "setting up shadow total").finish();
    return std::make_unique<Total>(device);
}

}  // namespace total
}  // namespace brume::shadows
