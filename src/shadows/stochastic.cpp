// SPDX-License-Identifier: Apache-2.0
// What:   coloured stochastic shadow map: per texel and channel the distance at which a light ray
//         ends, drawn at random; the share of rays that reach a point, under a tent.
// Source: E. Enderton, E. Sintorn, P. Shirley, D. Luebke: "Stochastic transparency", IEEE TVCG
//         17(8), 2011, section 3.6. doi:10.1109/TVCG.2010.123; M. McGuire, M. Mara: "A
//         phenomenological scattering model for order-independent transparency", I3D 2016,
//         section 4.3. doi:10.1145/2856400.2856418
// Equations: section 3.2, alpha correction -> stochasticTransmittance(); McGuire and Mara, eq. 10
//         to 12 (caustics) -> causticGain() of shaders/shadows/common/casters.glsl
// Differs: media end rays at exponentially distributed depths, not at their front, so that they
//         shadow themselves rightly; one random number for all channels, from a tile of blue noise
//         that is moved by the caster's id; the correction divides by what the samples themselves
//         lose behind everything.
// Limits: noise of .084 sqrt(p (1 - p)) under the tent of radius 7 without correction.
// Cost:   4 bytes per texel, sample and channel, with correction 4 more per channel;
//         (2 r + 2)^2 reads of each per lit point.
#include <gpu/upload.hpp>
#include <shadows/blue_noise.hpp>
#include <shadows/map_pass.hpp>
#include <shadows/stochastic.hpp>
#include <shadows/total.hpp>

#include <spv/shadows/stochastic/build.comp.hpp>

#include <cstring>
#include <optional>

namespace brume::shadows {

StochasticSettings readStochasticSettings(scene::SettingsReader& reader) {
    StochasticSettings settings;
    settings.samples = static_cast<std::uint32_t>(reader.integer("samples", 1, 1, 8));
    settings.isIndependent =
        reader.choice("mask", "stratified", {"stratified", "independent"}) == "independent";
    settings.filterRadius = static_cast<std::uint32_t>(reader.integer("filter", 7, 0, 16));
    return settings;
}

std::vector<scene::SettingInfo> listStochasticSettings() {
    return {{"samples", "1 .. 8", "1", "distances per texel and channel"},
            {"mask", "stratified, independent", "stratified", "how samples of a texel are drawn"},
            {"filter", "0 .. 16 texels", "7", "radius of the tent"}};
}

StochasticMap::StochasticMap(gpu::Device& device, const StochasticSettings& settings)
    : mDevice(&device),
      mSettings(settings),
      mBuild(
          makeMapPipeline(device, "shadow.stochastic.build", spv::shadows_stochastic_build_comp)) {}

void StochasticMap::allocate(shader::ShadowMap& map) {
    map.count = mSettings.samples;
    map.filterRadius = mSettings.filterRadius;
    map.isIndependent = mSettings.isIndependent;
    mDepths = {*mDevice,
               {.name = "shadow.stochastic.depths",
                .bytes = 4ull * mSettings.samples * map.channels * texelCount(map)}};
    const std::vector<float> noise = makeBlueNoise(shader::kNoiseSize);
    mNoise = {*mDevice,
              {.name = "shadow.stochastic.noise",
               .bytes = noise.size() * sizeof(float),
               .memory = gpu::MemoryKind::Upload}};
    std::memcpy(mNoise.mapped(), noise.data(), mNoise.bytes());
    map.texels = mDepths.deviceAddress();
    map.noise = mNoise.deviceAddress();
}

void StochasticMap::declare(frame::FrameBuilder& frame, const MapBuild& build) const {
    declareWalk(frame, "shadow.stochastic.build", build, mBuild, mDepths,
                mSettings.samples * (1 + build.map->channels));
}

namespace stochastic {
namespace {

class Stochastic final : public ShadowStore {
  public:
    Stochastic(gpu::Device& device, const StochasticSettings& settings, bool isCorrected)
        : mMap(device, settings) {
        if (isCorrected) mTotal.emplace(device);
    }
    const StoreInfo& info() const override;
    void allocate(shader::ShadowMap& map) override {
        mMap.allocate(map);
        if (mTotal) mTotal->allocate(map);
    }
    void declare(frame::FrameBuilder& frame, const MapBuild& build) const override {
        mMap.declare(frame, build);
        if (mTotal) mTotal->declare(frame, build);
    }
    std::uint64_t bytes() const override { return mMap.bytes() + (mTotal ? mTotal->bytes() : 0); }

  private:
    StochasticMap mMap;
    std::optional<TotalMap> mTotal;
};

}  // namespace

const StoreInfo& info() {
    static const StoreInfo kInfo = [] {
        StoreInfo made{
            .name = "stochastic",
            .summary = "Coloured stochastic shadow map, filtered, corrected by the total.",
            .paper = "Enderton, Sintorn, Shirley, Luebke: Stochastic Transparency, 2011",
            .result = "noisy and unbiased inside; with correction exact behind everything",
            .bytesPerTexel = "4 S c, with correction 4 c more; S samples, c channels",
            .limits = "shadows are as soft as the filter is wide",
            .bit = shader::kStoreStochastic,
            .settings = listStochasticSettings()};
        made.settings.push_back(
            {"alphaCorrection", "true, false", "true", "correct by the total transmittance"});
        return made;
    }();
    return kInfo;
}

const StoreInfo& Stochastic::info() const { return stochastic::info(); }

std::unique_ptr<ShadowStore> create(gpu::Device& device, const StoreRequest&,
                                    const scene::Settings& settings) {
    scene::SettingsReader reader(settings, "setting up shadow stochastic");
    const StochasticSettings values = readStochasticSettings(reader);
    const bool isCorrected = reader.boolean("alphaCorrection", true);
    reader.finish();
    return std::make_unique<Stochastic>(device, values, isCorrected);
}

}  // namespace stochastic
}  // namespace brume::shadows
