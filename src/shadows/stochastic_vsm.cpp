// SPDX-License-Identifier: Apache-2.0
// What:   mean and mean square of stochastic depths under a tent, a quarter of the map's size, read
//         once per lit point: Chebyshev's bound of the light that arrives.
// Source: M. McGuire, M. Mara: "A phenomenological scattering model for order-independent
//         transparency", I3D 2016, section 4.3. doi:10.1145/2856400.2856418; W. Donnelly,
//         A. Lauritzen: "Variance shadow maps", I3D 2006. doi:10.1145/1111411.1111440
// Equations: Donnelly and Lauritzen, eq. 5 -> stochasticVsmTransmittance()
// Differs: distances are linear, fitted to the casters, fp32; rays that nothing ends count as ended
//         at the far end of the range; no reduction of light bleeding, which biases thin shadows.
// Limits: right for receivers behind everything only: inside media two moments swap noise for bias.
// Cost:   8 bytes per texel of the reduced map and channel, 4 of the stochastic one, 8 / 4 of the
//         pass between; 8 reads per lit point and channel.
#include <shadows/map_pass.hpp>
#include <shadows/stochastic.hpp>

#include <shaders/shadows/stochastic_vsm/moments.h>
#include <spv/shadows/stochastic_vsm/blur.comp.hpp>

namespace brume::shadows::stochastic_vsm {
namespace {

using frame::Access;

class StochasticVsm final : public ShadowStore {
  public:
    StochasticVsm(gpu::Device& device, const StochasticSettings& settings)
        : mDevice(&device), mMap(device, settings) {
        for (std::uint32_t second = 0; second < 2; ++second)
            mBlur[second] = makeMapPipeline(device, "shadow.stochastic_vsm.blur",
                                            spv::shadows_stochastic_vsm_blur_comp, {second});
    }
    const StoreInfo& info() const override;
    void allocate(shader::ShadowMap& map) override;
    void declare(frame::FrameBuilder& frame, const MapBuild& build) const override;
    std::uint64_t bytes() const override { return mMap.bytes() + mRows.bytes() + mMoments.bytes(); }

  private:
    void declareBlur(frame::FrameBuilder& frame, const MapBuild& build, bool isSecond,
                     const gpu::Buffer& source, const gpu::Buffer& target) const;

    gpu::Device* mDevice;
    StochasticMap mMap;
    gpu::ComputePipeline mBlur[2];
    gpu::Buffer mRows, mMoments;
};

void StochasticVsm::allocate(shader::ShadowMap& map) {
    mMap.allocate(map);
    const std::uint64_t bytes = 8ull * map.channels * texelCount(map);
    mRows = {*mDevice,
             {.name = "shadow.stochastic_vsm.rows", .bytes = bytes / shader::kVsmReduction}};
    mMoments = {*mDevice,
                {.name = "shadow.stochastic_vsm.moments",
                 .bytes = bytes / (shader::kVsmReduction * shader::kVsmReduction)}};
    map.texels = mMoments.deviceAddress();
}

void StochasticVsm::declareBlur(frame::FrameBuilder& frame, const MapBuild& build, bool isSecond,
                                const gpu::Buffer& source, const gpu::Buffer& target) const {
    frame.addPass("shadow.stochastic_vsm.blur")
        .reads(frame.importBuffer(*build.mapBuffer), Access::ComputeRead)
        .reads(frame.importBuffer(source), Access::ComputeRead)
        .writes(frame.importBuffer(target), Access::ComputeWrite)
        .record([this, build, isSecond, &source, &target](gpu::Commands& commands,
                                                          const frame::PassResources&) {
            const auto count =
                static_cast<std::uint32_t>(target.bytes() / (8 * build.map->channels));
            commands.bindCompute(mBlur[isSecond]);
            bindCasters(commands, *build.casters);
            commands.pushConstants(shader::ShadowPush{.map = build.mapBuffer->deviceAddress(),
                                                      .target = target.deviceAddress(),
                                                      .source = source.deviceAddress(),
                                                      .count = count});
            commands.dispatchThreads(count, 64);
        });
}

void StochasticVsm::declare(frame::FrameBuilder& frame, const MapBuild& build) const {
    mMap.declare(frame, build);
    declareBlur(frame, build, false, mMap.depths(), mRows);
    declareBlur(frame, build, true, mRows, mMoments);
}

}  // namespace

const StoreInfo& info() {
    static const StoreInfo kInfo{
        .name = "stochastic_vsm",
        .summary = "Coloured stochastic depths converted to variance maps.",
        .paper = "McGuire, Mara: A Phenomenological Scattering Model for OIT, 2016",
        .result = "biased inside media and between panes",
        .bytesPerTexel = "4 S c + 2.5 c; S samples, c channels",
        .limits = "for receivers behind everything",
        .bit = shader::kStoreStochasticVsm,
        .settings = listStochasticSettings()};
    return kInfo;
}

const StoreInfo& StochasticVsm::info() const { return stochastic_vsm::info(); }

std::unique_ptr<ShadowStore> create(gpu::Device& device, const StoreRequest&,
                                    const scene::Settings& settings) {
    scene::SettingsReader reader(settings, "setting up shadow stochastic_vsm");
    const StochasticSettings values = readStochasticSettings(reader);
    reader.finish();
    return std::make_unique<StochasticVsm>(device, values);
}

}  // namespace brume::shadows::stochastic_vsm
