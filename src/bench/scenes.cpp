// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bench/scenes.hpp>
#include <random>

namespace brume::bench {
namespace {

constexpr std::array<SceneInfo, 12> kScenes = {{
    {"layers", "2, 4 ... 16 full-screen layers at 800x600 and 1024x768 (Barta, Kovacs 2011)"},
    {"spheres_1k_16", "1 000 spheres of 16 pixels radius, most of the screen empty"},
    {"spheres_1k_48", "1 000 spheres of 48 pixels radius, about 6.4 million intervals"},
    {"spheres_10k_15", "10 000 spheres of 15 pixels radius, seven per pixel"},
    {"spheres_10k_64", "10 000 spheres of 64 pixels radius, over a hundred per pixel"},
    {"spheres_100k_16", "100 000 spheres of 16 pixels radius"},
    {"spheres_10k_4", "10 000 spheres of 4 pixels radius"},
    {"spheres_100k_4", "100 000 spheres of 4 pixels radius"},
    {"spheres_1m_4", "1 000 000 spheres of 4 pixels radius"},
    {"mixed_10k_15", "10 000 spheres of 15 pixels radius, of two media that mix where they overlap"},
    {"mixed_10k_64", "10 000 spheres of 64 pixels radius, likewise"},
    {"intervals_8gib", "1 170 spheres that each cover the screen: 8 GiB of list entries"},
}};

constexpr std::array<ivec2, 2> kLayerSizes = {{{800, 600}, {1024, 768}}};

/// Numbers in [0, 1) that are the same with every standard library.
class Random {
  public:
    explicit Random(std::uint64_t seed) : mEngine(seed) {}
    double uniform() { return static_cast<double>(mEngine() >> 11) * 0x1p-53; }
    double uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }

  private:
    std::mt19937_64 mEngine;
};

scene::Mesh makeScreenQuad(float depth, std::uint32_t material) {
    scene::Mesh mesh;
    mesh.name = fmt::format("layer {}", material);
    for (const vec2 corner : {vec2(-2, -2), vec2(2, -2), vec2(2, 2), vec2(-2, 2)}) {
        mesh.positions.emplace_back(corner, -depth);
        mesh.normals.emplace_back(0, 0, 1);
        mesh.uvs.emplace_back(0, 0);
    }
    mesh.indices = {0, 1, 2, 0, 2, 3};
    mesh.material = material;
    return mesh;
}

void addDaylight(scene::Scene& scene) {
    scene::Light ambient;
    ambient.color = dvec3(0.4, 0.45, 0.5);
    scene::Light sun;
    sun.type = scene::LightType::Directional;
    sun.color = dvec3(2, 1.9, 1.7);
    sun.direction = glm::normalize(dvec3(0.6, -0.7, -0.39));
    scene.lights = {ambient, sun};
}

NamedScene makeNamedLayers(int layerCount, ivec2 size) {
    return {fmt::format("layers_{}_{}x{}", layerCount, size.x, size.y),
            makeLayers(layerCount, size.x, size.y), layerCount};
}

std::vector<NamedScene> makeLayerScenes(std::string_view name) {
    std::vector<NamedScene> scenes;
    for (const ivec2 size : kLayerSizes)
        for (int layerCount = 2; layerCount <= 16; layerCount += 2) {
            NamedScene scene = makeNamedLayers(layerCount, size);
            if (name == "layers" || name == scene.name) scenes.push_back(std::move(scene));
        }
    return scenes;
}

}  // namespace

std::span<const SceneInfo> listScenes() { return kScenes; }

std::vector<NamedScene> makeScenes(std::string_view name) {
    if (name == "spheres_1k_16") return {{std::string(name), makeSpheres(1'000, 16)}};
    if (name == "spheres_1k_48") return {{std::string(name), makeSpheres(1'000, 48)}};
    if (name == "spheres_10k_15") return {{std::string(name), makeSpheres(10'000, 15)}};
    if (name == "spheres_10k_64") return {{std::string(name), makeSpheres(10'000, 64)}};
    if (name == "spheres_100k_16") return {{std::string(name), makeSpheres(100'000, 16)}};
    if (name == "spheres_10k_4") return {{std::string(name), makeSpheres(10'000, 4)}};
    if (name == "spheres_100k_4") return {{std::string(name), makeSpheres(100'000, 4)}};
    if (name == "spheres_1m_4") return {{std::string(name), makeSpheres(1'000'000, 4)}};
    if (name == "mixed_10k_15") return {{std::string(name), makeSpheres(10'000, 15, 2)}};
    if (name == "mixed_10k_64") return {{std::string(name), makeSpheres(10'000, 64, 2)}};
    if (name == "intervals_8gib") return {{std::string(name), makeNestedSpheres(1'170)}};
    return makeLayerScenes(name);
}

scene::Scene makeLayers(int layerCount, int width, int height) {
    scene::Scene scene;
    scene.image = {width, height, 1};
    scene.camera.type = scene::CameraType::Orthographic;
    scene.camera.position = dvec3(0);
    scene.camera.target = dvec3(0, 0, -1);
    scene.camera.height = 1;
    scene.background.radiance = dvec3(1, 0.9, 0.7);
    addDaylight(scene);
    for (int i = 0; i < layerCount; ++i) {
        scene::Material material;
        material.name = fmt::format("layer {}", i);
        material.type = scene::MaterialType::Thin;
        material.coverage = 0.5;
        const double hue = 2 * kPi * i / layerCount;
        material.reflected = 0.5 + 0.4 * dvec3(std::cos(hue), std::cos(hue - 2), std::cos(hue + 2));
        scene.materials.push_back(material);
        // Every fifth distance of a ring of 17: neither front to back nor back to front.
        const float depth = 1.f + 0.1f * static_cast<float>((5 * i + 3) % 17);
        scene.meshes.push_back(makeScreenQuad(depth, static_cast<std::uint32_t>(i)));
    }
    return scene;
}

namespace {

scene::Scene makeSmokyScene() {
    scene::Scene scene;
    scene.image = {1280, 720, 1};
    scene.camera.position = dvec3(0);
    scene.camera.target = dvec3(0, 0, -1);
    scene.background.radiance = dvec3(0.1, 0.15, 0.25);
    addDaylight(scene);
    scene::Medium medium;
    medium.name = "smoke";
    medium.albedo = dvec3(0.9, 0.85, 0.8);
    scene.media = {medium};
    return scene;
}

}  // namespace

scene::Scene makeNestedSpheres(int count) {
    scene::Scene scene = makeSmokyScene();
    for (int i = 0; i < count; ++i) {
        scene::Sphere sphere;
        sphere.center = dvec3(0, 0, -4 - 8.0 * i / count);
        sphere.radius =
            -0.65 * sphere.center.z;  // seen under 40 degrees from the axis: past the corners
        sphere.density = 1.5 / (count * sphere.radius);
        scene.spheres.push_back(sphere);
    }
    return scene;
}

scene::Scene makeSpheres(int count, double radiusPixels, int mediumCount) {
    scene::Scene scene = makeSmokyScene();
    for (int m = 1; m < mediumCount; ++m) {
        scene.media.push_back(scene.media[0]);
        scene.media.back().name = fmt::format("smoke {}", m);
        scene.media.back().albedo *= dvec3(0.5, 0.8, 1.1);
    }

    const double pixel = 2 * std::tan(0.5 * scene.camera.verticalFov) / scene.image.height;
    Random random(static_cast<std::uint64_t>(count));
    for (int i = 0; i < count; ++i) {
        // Centres reach half a radius beyond the border, so that borders are as full as the middle.
        const double x = random.uniform(-0.5, 0.5) * (scene.image.width + radiusPixels) * pixel;
        const double y = random.uniform(-0.5, 0.5) * (scene.image.height + radiusPixels) * pixel;
        const double depth = random.uniform(4, 12);
        scene::Sphere sphere;
        sphere.center = depth * dvec3(x, y, -1);
        // A small sphere off the axis covers 1/cos(angle) more than one on it.
        sphere.radius = radiusPixels * pixel * depth / std::pow(1 + x * x + y * y, 0.25);
        sphere.density = 0.4 / (2 * sphere.radius);
        sphere.medium = static_cast<std::uint32_t>(i % mediumCount);
        scene.spheres.push_back(sphere);
    }
    return scene;
}

}  // namespace brume::bench
