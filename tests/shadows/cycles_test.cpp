// SPDX-License-Identifier: Apache-2.0
// Shadows inside real smoke against Blender's Cycles, an independent renderer.
#include <core/image_io.hpp>
#include <shadows/shadow_fixture.hpp>
#include <volumes/vdb_file.hpp>

namespace brume::test {
namespace {

struct CyclesDifference {
    double rmse = 0;
    double blockRmse = 0;  ///< of the means of 4 x 4 pixels
};

double computeRmse(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const dvec3 d = dvec3(a.pixels[i]) - dvec3(b.pixels[i]);
        sum += glm::dot(d, d);
    }
    return std::sqrt(sum / (3.0 * static_cast<double>(a.pixels.size())));
}

class ShadowCycles : public ShadowTest {
  protected:
    CyclesDifference compare(const std::string& shadow) {
        const std::filesystem::path data(BRUME_SHARED_DATA_DIR);
        const Image expected = readImage(data / "reference/fire16_0030_single_scattering.exr");
        TestScene s(expected.width, expected.height);
        s.scene.background.radiance = dvec3(0);
        s.addMedium(4, 1);
        addSun(s, shadow, dvec3(0.6, -0.7, -0.39)).color = dvec3(kPi);
        s.scene.volumes.resize(1);
        s.scene.volumes[0].file = data / "blender/fire16/fluid_data_0030.vdb";
        s.volumes = {volumes::loadVolume(s.scene.volumes[0], 4, Log())};
        s.scene.camera.type = scene::CameraType::Orthographic;
        s.scene.camera.position = dvec3(0.96875, 0.96875, s.volumes[0].worldBounds().hi.z + 1);
        s.scene.camera.target = s.scene.camera.position - dvec3(0, 0, 1);
        s.scene.camera.height = 2.5;
        const Image image = render(s, {.settings = {{"shadow.resolution", "128"}}}).image;
        return {computeRmse(image, expected),
                computeRmse(downsample(image, 4), downsample(expected, 4))};
    }
};

// Cycles' 256 samples per pixel leave white noise of 7.2e-4, and one sample per pixel adds a little
// where Cycles averages; in means of 16 pixels a quarter of the noise is left.
TEST_F(ShadowCycles, Fire16_ReproducedByVisibility) {
    if (!std::filesystem::exists(std::filesystem::path(BRUME_SHARED_DATA_DIR) / "reference"))
        GTEST_SKIP() << "needs " << BRUME_SHARED_DATA_DIR << "/reference";
    const CyclesDifference difference = compare("visibility");
    EXPECT_LE(difference.rmse, 1.5e-3);
    EXPECT_LE(difference.blockRmse, 5e-4);
}

TEST_F(ShadowCycles, Fire16_ReproducedExactly) {
    if (!std::filesystem::exists(std::filesystem::path(BRUME_SHARED_DATA_DIR) / "reference"))
        GTEST_SKIP() << "needs " << BRUME_SHARED_DATA_DIR << "/reference";
    const CyclesDifference difference = compare("exact");
    EXPECT_LE(difference.rmse, 9e-4);
    EXPECT_LE(difference.blockRmse, 2.5e-4);
}

}  // namespace
}  // namespace brume::test
