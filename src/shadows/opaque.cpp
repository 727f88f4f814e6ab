// SPDX-License-Identifier: Apache-2.0
// What:   the nearest opaque surface along each texel's ray, compared under a tent of radius r.
// Source: W. Reeves, D. Salesin, R. Cook: "Rendering antialiased shadows with depth maps",
//         SIGGRAPH 1987. doi:10.1145/37401.37435
// Equations: percentage-closer filtering -> opaqueVisibility()
// Differs: rays are cast through the texels' centres instead of rasterising, so that no caster
//         crosses a near plane; surfaces are lit from a point off them by the filter's width.
// Limits: shadows end 1.5 (r + 1) texels before what casts them.
// Cost:   4 bytes per texel; one ray per texel, (2 r + 2)^2 reads per lit point.
#include <shadows/map_pass.hpp>

#include <spv/shadows/opaque/build.comp.hpp>

namespace brume::shadows::opaque {
namespace {

class Opaque final : public ShadowStore {
  public:
    explicit Opaque(gpu::Device& device)
        : mDevice(&device),
          mBuild(makeMapPipeline(device, "shadow.opaque.build", spv::shadows_opaque_build_comp)) {}

    const StoreInfo& info() const override;
    void allocate(shader::ShadowMap& map) override {
        mDistances = {*mDevice, {.name = "shadow.opaque.distances", .bytes = 4 * texelCount(map)}};
        map.texels = mDistances.deviceAddress();
    }
    void declare(frame::FrameBuilder& frame, const MapBuild& build) const override {
        declareTexels(frame, "shadow.opaque.build", build, mBuild, mDistances);
    }
    std::uint64_t bytes() const override { return mDistances.bytes(); }

  private:
    gpu::Device* mDevice;
    gpu::ComputePipeline mBuild;
    gpu::Buffer mDistances;
};

}  // namespace

const StoreInfo& info() {
    static const StoreInfo kInfo{
        .name = "opaque",
        .summary = "Depth map of opaque casters with percentage-closer filtering.",
        .paper = "Reeves, Salesin, Cook: Rendering Antialiased Shadows with Depth Maps, 1987",
        .result = "hard casters only; edges as wide as the filter",
        .bytesPerTexel = "4",
        .limits = "media and glass cast no shadow",
        .bit = shader::kStoreOpaque,
        .settings = {}};
    return kInfo;
}

const StoreInfo& Opaque::info() const { return opaque::info(); }

std::unique_ptr<ShadowStore> create(gpu::Device& device, const StoreRequest&,
                                    const scene::Settings& settings) {
    scene::SettingsReader(settings, "setting up shadow opaque").finish();
    return std::make_unique<Opaque>(device);
}

}  // namespace brume::shadows::opaque
