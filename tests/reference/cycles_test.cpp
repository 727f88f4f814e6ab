// SPDX-License-Identifier: Apache-2.0
// The exact renderer against Blender's Cycles, an independent renderer: real smoke, absorbing and
// scattering.
#include <core/image_io.hpp>
#include <reference/reference.hpp>
#include <volumes/vdb_file.hpp>

#include <gtest/gtest.h>

namespace brume::reference {
namespace {

/// A volume and where Cycles' camera looked: orthographic along -z, +y up.
struct CyclesView {
    const char* volume;
    double centerX, centerY;
    double scale;  ///< of the larger image dimension, in world units
};
constexpr CyclesView kSmoke1{"vdb/openvdb_smoke1.vdb", -7.381, 40.476, 120};
constexpr CyclesView kFire16{"blender/fire16/fluid_data_0030.vdb", 0.96875, 0.96875, 2.5};

/// One rendering of Cycles (box filter), and how finely we render the same.
struct CyclesImage {
    const char* image;
    const CyclesView& view;
    int supersample;
};

std::filesystem::path dataPath(const char* file) {
    return std::filesystem::path(BRUME_SHARED_DATA_DIR) / file;
}

void setCamera(scene::Scene& scene, const CyclesImage& cycles, const Image& image, double zFront) {
    scene.image = {image.width, image.height, cycles.supersample};
    scene.camera.type = scene::CameraType::Orthographic;
    scene.camera.position = dvec3(cycles.view.centerX, cycles.view.centerY, zFront);
    scene.camera.target = scene.camera.position - dvec3(0, 0, 1);
    scene.camera.height = cycles.view.scale * image.height / std::max(image.width, image.height);
}

/// Root mean square over pixels and channels.
double computeRmse(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const dvec3 difference = dvec3(a.pixels[i]) - dvec3(b.pixels[i]);
        sum += glm::dot(difference, difference);
    }
    return std::sqrt(sum / (3.0 * static_cast<double>(a.pixels.size())));
}

/// Differences of the reference with one medium and these lights.
struct Difference {
    double rmse = 0;
    double blockRmse = 0;  ///< of the means of 4 x 4 pixels
};

Difference compare(const CyclesImage& cycles, const scene::Medium& medium, const dvec3& background,
                   const std::vector<scene::Light>& lights) {
    const Image expected = readImage(dataPath(cycles.image));
    scene::Scene scene;
    scene.media = {medium};
    scene.lights = lights;
    scene.background.radiance = background;
    scene.volumes.resize(1);
    scene.volumes[0].file = dataPath(cycles.view.volume);
    const std::vector<volumes::VolumeGrid> grids{
        volumes::loadVolume(scene.volumes[0], medium.extinction.x, Log())};
    setCamera(scene, cycles, expected, grids[0].worldBounds().hi.z + 1);
    const Image image = render({scene, grids, {}}).image;
    return {computeRmse(image, expected),
            computeRmse(downsample(image, 4), downsample(expected, 4))};
}

scene::Medium absorbing(double extinction) {
    scene::Medium medium;
    medium.extinction = dvec3(extinction);
    return medium;
}

class ReferenceCycles : public testing::Test {
  protected:
    void SetUp() override {
        if (!std::filesystem::exists(dataPath("reference")))
            GTEST_SKIP() << "needs " << dataPath("reference");
    }
};

TEST_F(ReferenceCycles, Smoke1Absorption_AgreesTo3e4) {
    const CyclesImage cycles{"reference/smoke1_absorption.exr", kSmoke1, 8};
    EXPECT_LE(compare(cycles, absorbing(0.3), dvec3(1), {}).rmse, 3e-4);
}

TEST_F(ReferenceCycles, Fire16Absorption_AgreesTo3e4) {
    const CyclesImage cycles{"reference/fire16_0030_absorption.exr", kFire16, 4};
    EXPECT_LE(compare(cycles, absorbing(4), dvec3(1), {}).rmse, 3e-4);
}

TEST_F(ReferenceCycles, Fire16SingleScattering_AgreesToTheNoiseOfCycles) {
    const CyclesImage cycles{"reference/fire16_0030_single_scattering.exr", kFire16, 2};
    scene::Medium medium = absorbing(4);
    medium.albedo = dvec3(1);
    scene::Light sun;
    sun.type = scene::LightType::Directional;
    sun.color = dvec3(kPi);
    sun.direction = glm::normalize(dvec3(0.6, -0.7, -0.39));
    sun.shadow = "exact";
    // Cycles' 256 samples per pixel leave white noise of 7.2e-4 (from the fourth differences of its
    // image less those of ours); nothing else remains: means of 16 pixels differ four times less.
    const Difference difference = compare(cycles, medium, dvec3(0), {sun});
    EXPECT_LE(difference.rmse, 7.6e-4);
    EXPECT_LE(difference.blockRmse, 2e-4);
}

}  // namespace
}  // namespace brume::reference
