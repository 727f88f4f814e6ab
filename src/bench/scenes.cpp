// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <regex>
#include <bench/hard_scenes.hpp>
#include <bench/prepare.hpp>
#include <bench/scene_builder.hpp>
#include <bench/scene_parts.hpp>
#include <bench/suites/needs.hpp>
#include <bench/volume_scenes.hpp>
#include <bench/scenes.hpp>

namespace brume::bench {
namespace {

constexpr std::array<SceneInfo, 27> kScenes = {{
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
    {"shadow_panes", "three coloured panes across a sun, for shadow stores"},
    {"shadow_discs", "400 soft coloured discs across a sun, for shadow stores"},
    {"glass_bars", "two layers of coloured glass bars, crossed (McGuire, Mara 2016, figure 2)"},
    {"frosted_panes", "panes of falling collimation before a row of spheres (figure 3)"},
    {"foggy_street", "a street at night in fog with lamps (figure 1)"},
    {"smoke_and_glass", "smoke through and behind panes and solid glass (figure 12)"},
    {"plume_100k", "a smoke plume of 100 000 particles"},
    {"engine", "many close shells of partial coverage (figure 9)"},
    {"fur", "6 000 hairs of half coverage"},
    {"mixed", "smoke, foliage cards, ribbons, window panes and sheer cloth"},
    {"mesh_spheres", "1 000 half-transparent spheres of triangles, 10 x 10 x 10 at 1280x720"},
    {"hard", "inputs at which renderers of transparency break; hard_<name> for one"},
    {"boxes_30", "a cloud of voxels as boxes of tolerance 0.030; boxes_0: as voxels"},
    {"shadowed_cloud", "a cloud of 96^3 voxels in a sun that casts shadows"},
    {"needs", "pairs of scenes that differ in one feature; need_<name> for one"},
}};

constexpr std::array<ivec2, 2> kLayerSizes = {{{800, 600}, {1024, 768}}};

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

NamedScene makeNamedLayers(int layerCount, ivec2 size) {
    return {fmt::format("layers_{}_{}x{}", layerCount, size.x, size.y),
            makeLayers(layerCount, size.x, size.y), layerCount};
}

std::vector<NamedScene> makePaperLayers() {
    std::vector<NamedScene> scenes;
    for (const ivec2 size : kLayerSizes)
        for (int layerCount = 2; layerCount <= 16; layerCount += 2)
            scenes.push_back(makeNamedLayers(layerCount, size));
    return scenes;
}

/// 500, 10k, 1m; 0 for anything else.
int parseCount(const std::string& digits, const std::string& unit) {
    if (digits.size() > 7) return 0;
    const int scale = unit == "k" ? 1'000 : unit == "m" ? 1'000'000 : 1;
    const long long count = std::stoll(digits) * scale;
    return count <= 4'000'000 ? static_cast<int>(count) : 0;
}

/// Scenes whose names hold their numbers.
std::optional<NamedScene> makeNumbered(const std::string& name) {
    static const std::regex kLayers("layers_(\\d{1,3})_(\\d{1,5})x(\\d{1,5})");
    static const std::regex kSpheres("(spheres|mixed)_(\\d+)([km]?)_(\\d{1,3})");
    std::smatch part;
    if (std::regex_match(name, part, kLayers)) {
        const ivec2 size(std::stoi(part[2]), std::stoi(part[3]));
        const int count = std::stoi(part[1]);
        if (count < 1 || count > 256 || size.x < 1 || size.y < 1) return std::nullopt;
        return makeNamedLayers(count, size);
    }
    if (!std::regex_match(name, part, kSpheres)) return std::nullopt;
    const int count = parseCount(part[2], part[3]), radius = std::stoi(part[4]);
    if (count < 1 || radius < 1) return std::nullopt;
    return NamedScene{name, makeSpheres(count, radius, part[1] == "mixed" ? 2 : 1)};
}

}  // namespace

std::span<const SceneInfo> listScenes() { return kScenes; }

std::vector<NamedScene> makeScenes(std::string_view name) {
    if (name == "layers") return makePaperLayers();
    if (name == "intervals_8gib") return {{std::string(name), makeNestedSpheres(1'170)}};
    if (name == "shadow_panes") return {{std::string(name), makeShadowPanes()}};
    if (name == "shadow_discs") return {{std::string(name), makeShadowDiscs(400)}};
    if (name == "mesh_spheres") return {{std::string(name), makeMeshSpheres()}};
    if (name == "shadowed_cloud") return {makeShadowedCloud()};
    if (auto scene = makeTransparencyScene(name)) return {{std::string(name), *std::move(scene)}};
    if (auto scene = makeNumbered(std::string(name))) return {*std::move(scene)};
    if (auto scene = makeBoxesScene(std::string(name))) return {*std::move(scene)};
    if (auto scenes = makeHardScenes(name); !scenes.empty()) return scenes;
    return makeNeedScenes(name);
}

render::PreparedScene prepareNamed(const NamedScene& named, const Log& log) {
    render::PreparedScene prepared = prepareScene(named.scene, log);
    for (const auto& [volume, grid] : named.volumes) {
        prepared.scene.volumes.push_back(volume);
        prepared.volumes.push_back(grid);
    }
    return prepared;
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
        // Every fifth distance of a ring: neither front to back nor back to front.
        const int ring = layerCount <= 16 ? 17 : 257;
        const float depth =
            1.f + 1.7f * static_cast<float>((5 * i + 3) % ring) / static_cast<float>(ring);
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

namespace {

scene::Scene makeSunlitScene() {
    scene::Scene scene;
    scene.image = {64, 64, 1};
    scene.camera.position = dvec3(0, 0, 4);
    scene::Light sun;
    sun.type = scene::LightType::Directional;
    sun.color = dvec3(3);
    sun.direction = dvec3(0, -1, 0);
    sun.shadow = "visibility";
    scene.lights = {sun};
    return scene;
}

/// Squares in the XZ plane of edge 2 `radius`, texture from corner to corner.
void addSquare(const dvec3& center, double radius, scene::Mesh& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const vec2 corner : {vec2(0, 0), vec2(0, 1), vec2(1, 1), vec2(1, 0)}) {
        const dvec3 offset(2 * corner.x - 1, 0, 2 * corner.y - 1);
        mesh.positions.emplace_back(center + radius * offset);
        mesh.normals.emplace_back(0, 1, 0);
        mesh.uvs.push_back(corner);
    }
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
}

std::shared_ptr<const scene::Texture> makeSoftDisc(int size) {
    auto texture = std::make_shared<scene::Texture>();
    texture->name = "soft disc";
    texture->width = texture->height = size;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const dvec2 p = (dvec2(x, y) + 0.5) * (2.0 / size) - 1.0;
            const double q = std::max(1 - glm::dot(p, p), 0.0);
            texture->texels.emplace_back(1, 1, 1, static_cast<float>(q * q));
        }
    return texture;
}

}  // namespace

scene::Scene makeMeshSpheres() {
    Builder b(dvec3(0, 0, 17), dvec3(0), 40);
    b.scene.image = {1280, 720, 1};
    b.scene.background.radiance = dvec3(0.1, 0.15, 0.25);
    addDaylight(b.scene);
    for (int i = 0; i < 1000; ++i) {
        const dvec3 cell(i % 10, i / 10 % 10, i / 100);
        if (i < 10) b.addThin(0.5, dvec3(0), 0.2 + 0.6 * dvec3(i % 3 == 0, i % 3 == 1, 0.1 * i));
        b.addMesh(scene::makeSphere(0.42, 12), static_cast<std::uint32_t>((i * 7 + i / 100) % 10),
                  place(cell - 4.5));
    }
    return b.scene;
}

scene::Scene makeShadowPanes() {
    scene::Scene scene = makeSunlitScene();
    const dvec3 colors[3] = {{0.9, 0.3, 0.2}, {0.3, 0.8, 0.4}, {0.4, 0.5, 0.9}};
    for (std::uint32_t i = 0; i < 3; ++i) {
        scene::Material material;
        material.name = fmt::format("pane {}", i);
        material.type = scene::MaterialType::Thin;
        material.coverage = 0.7;
        material.transmission = colors[i];
        scene.materials.push_back(material);
        scene::Mesh mesh;
        mesh.material = i;
        addSquare(dvec3(0, 0.5 - 0.5 * i, 0), 1, mesh);
        scene.meshes.push_back(mesh);
    }
    return scene;
}

scene::Scene makeShadowDiscs(int count) {
    constexpr int kColors = 16, kTexels = 64;
    scene::Scene scene = makeSunlitScene();
    const auto texture = makeSoftDisc(kTexels);
    Random random(static_cast<std::uint64_t>(count));
    for (std::uint32_t i = 0; i < kColors; ++i) {
        scene::Material material;
        material.name = fmt::format("disc {}", i);
        material.type = scene::MaterialType::Thin;
        material.coverage = 0.6;
        const double r = random.uniform(), g = random.uniform(), b = random.uniform();
        material.transmission = dvec3(r, g, b);
        material.colorTexture = texture;
        scene.materials.push_back(material);
        scene.meshes.emplace_back().material = i;
    }
    for (int i = 0; i < count; ++i) {
        const double x = random.uniform(-1, 1), y = random.uniform(-1, 1),
                     z = random.uniform(-1, 1);
        addSquare(dvec3(x, y, z), 0.12, scene.meshes[static_cast<std::size_t>(i % kColors)]);
    }
    return scene;
}

}  // namespace brume::bench
