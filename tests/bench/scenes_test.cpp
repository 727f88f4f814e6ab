// SPDX-License-Identifier: Apache-2.0
// The built-in scenes are what their names say.
#include <gtest/gtest.h>

#include <algorithm>
#include <bench/scenes.hpp>
#include <scene/camera.hpp>
#include <set>

namespace brume::bench {
namespace {

TEST(Scenes, EveryListedName_MakesSomething) {
    for (const SceneInfo& info : listScenes())
        EXPECT_FALSE(makeScenes(info.name).empty()) << info.name;
    EXPECT_TRUE(makeScenes("no_such_scene").empty());
    EXPECT_TRUE(makeScenes("").empty());
}

TEST(Scenes, Layers_AreTheSixteenOfThePaper) {
    const auto scenes = makeScenes("layers");
    ASSERT_EQ(scenes.size(), 16u);
    for (const NamedScene& named : scenes) {
        EXPECT_EQ(static_cast<int>(named.scene.meshes.size()), named.layerCount);
        EXPECT_EQ(makeScenes(named.name).size(), 1u) << "each can be chosen alone";
    }
    EXPECT_EQ(scenes.front().name, "layers_2_800x600");
    EXPECT_EQ(scenes.back().name, "layers_16_1024x768");
}

TEST(Scenes, Layers_CoverTheScreenAtDifferentDepths) {
    const scene::Scene layers = makeLayers(16, 1024, 768);
    std::set<float> depths;
    for (const scene::Mesh& mesh : layers.meshes) {
        depths.insert(mesh.positions[0].z);
        for (const vec3& corner : mesh.positions) {
            EXPECT_GE(std::abs(corner.x), layers.camera.height * 1024 / 768 / 2);
            EXPECT_GE(std::abs(corner.y), layers.camera.height / 2);
        }
    }
    EXPECT_EQ(depths.size(), 16u);
    EXPECT_LT(*depths.rbegin(), -layers.camera.near);
}

/// Pixels of a 1280x720 image that the spheres cover, counted once per sphere.
double countIntervals(const scene::Scene& scene, int step) {
    const scene::CameraFrame frame =
        scene::makeCameraFrame(scene.camera, scene.image.width, scene.image.height);
    double count = 0;
    for (int y = step / 2; y < scene.image.height; y += step)
        for (int x = step / 2; x < scene.image.width; x += step) {
            const scene::Ray ray = frame.ray(x + 0.5, y + 0.5);
            for (const scene::Sphere& sphere : scene.spheres) {
                const dvec3 toCenter = sphere.center - ray.origin;
                const dvec3 across = toCenter - glm::dot(toCenter, ray.direction) * ray.direction;
                count += glm::dot(across, across) < sphere.radius * sphere.radius;
            }
        }
    return count * step * step;
}

TEST(Scenes, Spheres1k48_HaveSixPointFourMillionIntervals) {
    const scene::Scene scene = makeSpheres(1000, 48);
    EXPECT_EQ(scene.spheres.size(), 1000u);
    EXPECT_NEAR(countIntervals(scene, 8), 6.4e6, 0.1e6);
}

TEST(Scenes, TransparencyScenes_HoldWhatTheirNamesSay) {
    const auto countThin = [](const scene::Scene& scene) {
        return std::count_if(scene.meshes.begin(), scene.meshes.end(), [&](const auto& mesh) {
            return scene.materials[mesh.material].type == scene::MaterialType::Thin;
        });
    };
    EXPECT_EQ(countThin(makeScenes("glass_bars")[0].scene), 12);
    EXPECT_EQ(countThin(makeScenes("engine")[0].scene), 60);
    EXPECT_EQ(makeScenes("plume_100k")[0].scene.spheres.size(), 100'000u);
    const scene::Scene frosted = makeScenes("frosted_panes")[0].scene;
    std::set<double> collimations;
    for (const scene::Material& material : frosted.materials)
        if (material.type == scene::MaterialType::Thin) collimations.insert(material.collimation);
    EXPECT_EQ(collimations, (std::set<double>{0, 0.25, 0.5, 0.75, 1}));
    const scene::Scene mixed = makeScenes("mixed")[0].scene;
    EXPECT_TRUE(std::any_of(mixed.materials.begin(), mixed.materials.end(),
                            [](const auto& material) { return material.colorTexture; }));
    EXPECT_FALSE(mixed.spheres.empty());
}

TEST(Scenes, Spheres_AreTheSameEveryTime) {
    const scene::Scene a = makeSpheres(100, 15), b = makeSpheres(100, 15);
    for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(a.spheres[i].center, b.spheres[i].center);
}

}  // namespace
}  // namespace brume::bench
