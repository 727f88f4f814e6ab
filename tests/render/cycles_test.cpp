// SPDX-License-Identifier: Apache-2.0
// linked_list against Blender's Cycles, an independent renderer: real smoke, absorbing.
#include <core/image_io.hpp>
#include <render/render_fixture.hpp>
#include <volumes/vdb_file.hpp>

namespace brume::test {
namespace {

/// A volume and where Cycles' camera looked: orthographic along -z, +y up.
struct CyclesImage {
    const char* image;
    const char* volume;
    double extinction;
    double centerX, centerY;
    double scale;  ///< of the larger image dimension, in world units
    int supersample;
};

constexpr CyclesImage kSmoke1{
    "reference/smoke1_absorption.exr", "vdb/openvdb_smoke1.vdb", 0.3, -7.381, 40.476, 120, 8};
constexpr CyclesImage kFire16{"reference/fire16_0030_absorption.exr",
                              "blender/fire16/fluid_data_0030.vdb",
                              4,
                              0.96875,
                              0.96875,
                              2.5,
                              4};

std::filesystem::path dataPath(const char* file) {
    return std::filesystem::path(BRUME_SHARED_DATA_DIR) / file;
}

class Cycles : public RenderTest {
  protected:
    void SetUp() override {
        RenderTest::SetUp();
        if (!std::filesystem::exists(dataPath("reference")))
            GTEST_SKIP() << "needs " << dataPath("reference");
    }

    double computeRmse(const CyclesImage& cycles) {
        const Image expected = readImage(dataPath(cycles.image));
        TestScene s(expected.width, expected.height);
        s.scene.image.supersample = cycles.supersample;
        s.scene.background.radiance = dvec3(1);
        s.addMedium(cycles.extinction);
        s.scene.volumes.resize(1);
        s.scene.volumes[0].file = dataPath(cycles.volume);
        s.volumes = {volumes::loadVolume(s.scene.volumes[0], cycles.extinction, Log())};
        s.scene.camera.type = scene::CameraType::Orthographic;
        s.scene.camera.position =
            dvec3(cycles.centerX, cycles.centerY, s.volumes[0].worldBounds().hi.z + 1);
        s.scene.camera.target = s.scene.camera.position - dvec3(0, 0, 1);
        s.scene.camera.height =
            cycles.scale * expected.height / std::max(expected.width, expected.height);
        const Image image = render(s).image;
        double sum = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            const dvec3 d = dvec3(image.pixels[i]) - dvec3(expected.pixels[i]);
            sum += glm::dot(d, d);
        }
        return std::sqrt(sum / (3.0 * static_cast<double>(image.pixels.size())));
    }
};

TEST_F(Cycles, Smoke1Absorption_AgreesTo3e4) { EXPECT_LE(computeRmse(kSmoke1), 3e-4); }

TEST_F(Cycles, Fire16Absorption_AgreesTo3e4) { EXPECT_LE(computeRmse(kFire16), 3e-4); }

}  // namespace
}  // namespace brume::test
