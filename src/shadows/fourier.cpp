// SPDX-License-Identifier: Apache-2.0
// What:   the extinction along each texel's ray as a Fourier series over the casters' range.
// Source: J. Jansen, L. Bavoil: "Fourier opacity mapping", I3D 2010. doi:10.1145/1730804.1730831
// Equations: eq. 5 and 6 -> takePiece() of build.comp; eq. 7 and 8 -> fourierTexel()
// Differs: extinction spread over stretches is integrated, not sampled; per channel where casters
//         are coloured.
// Limits: rings around surfaces and thin dense media.
// Cost:   4 bytes per texel, coefficient and channel; 4 reads of each per lit point.
#include <core/error.hpp>
#include <shadows/map_pass.hpp>

#include <spv/shadows/fourier/build.comp.hpp>

namespace brume::shadows::fourier {
namespace {

class Fourier final : public ShadowStore {
  public:
    Fourier(gpu::Device& device, std::uint32_t coefficientCount)
        : mDevice(&device),
          mCoefficientCount(coefficientCount),
          mBuild(makeMapPipeline(device, "shadow.fourier.build", spv::shadows_fourier_build_comp)) {
    }

    const StoreInfo& info() const override;
    void allocate(shader::ShadowMap& map) override {
        map.count = mCoefficientCount;
        mCoefficients = {*mDevice,
                         {.name = "shadow.fourier.coefficients",
                          .bytes = 4ull * mCoefficientCount * map.channels * texelCount(map)}};
        map.texels = mCoefficients.deviceAddress();
    }
    void declare(frame::FrameBuilder& frame, const MapBuild& build) const override {
        declareWalk(frame, "shadow.fourier.build", build, mBuild, mCoefficients,
                    mCoefficientCount / 2);
    }
    std::uint64_t bytes() const override { return mCoefficients.bytes(); }

  private:
    gpu::Device* mDevice;
    std::uint32_t mCoefficientCount;
    gpu::ComputePipeline mBuild;
    gpu::Buffer mCoefficients;
};

}  // namespace

const StoreInfo& info() {
    static const StoreInfo kInfo{
        .name = "fourier",
        .summary = "Extinction along the light ray as a Fourier series.",
        .paper = "Jansen, Bavoil: Fourier Opacity Mapping, 2010",
        .result = "smooth media well, surfaces with rings",
        .bytesPerTexel = "4 n c, n coefficients, c channels",
        .limits = "surfaces and thin dense media",
        .bit = shader::kStoreFourier,
        .settings = {{"coefficients", "7, 15", "15", "length of the series"}}};
    return kInfo;
}

const StoreInfo& Fourier::info() const { return fourier::info(); }

std::unique_ptr<ShadowStore> create(gpu::Device& device, const StoreRequest&,
                                    const scene::Settings& settings) {
    scene::SettingsReader reader(settings, "setting up shadow fourier");
    const std::string count = reader.choice("coefficients", "15", {"7", "15"});
    reader.finish();
    return std::make_unique<Fourier>(device, count == "7" ? 7 : 15);
}

}  // namespace brume::shadows::fourier
