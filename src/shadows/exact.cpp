// SPDX-License-Identifier: Apache-2.0
// What:   exact transmittance: every caster of the point's tile of the map is intersected with the
//         light ray through the point itself; optical depths add up, surfaces multiply.
// Source: -
// Limits: a light inside a solid that the point is outside of; costs as much as there are casters
//         along the ray, at every point.
// Cost:   lists of the tiles only, 8 bytes per caster and tile that it touches.
#include <shadows/shadow_store.hpp>

namespace brume::shadows::exact {
namespace {

class Exact final : public ShadowStore {
  public:
    const StoreInfo& info() const override;
    void allocate(shader::ShadowMap&) override {}
    void declare(frame::FrameBuilder&, const MapBuild&) const override {}
    std::uint64_t bytes() const override { return 0; }
};

}  // namespace

const StoreInfo& info() {
    static const StoreInfo kInfo{
        .name = "exact",
        .summary = "Every caster of a tile is intersected with the light ray of each lit point.",
        .paper = "-",
        .result = "exact",
        .bytesPerTexel = "8 c / 64 for c casters per tile",
        .limits = "slow; a light inside solid glass",
        .bit = shader::kStoreExact,
        .settings = {}};
    return kInfo;
}

const StoreInfo& Exact::info() const { return exact::info(); }

std::unique_ptr<ShadowStore> create(gpu::Device&, const StoreRequest&,
                                    const scene::Settings& settings) {
    scene::SettingsReader(settings, "setting up shadow exact").finish();
    return std::make_unique<Exact>();
}

}  // namespace brume::shadows::exact
