// SPDX-License-Identifier: Apache-2.0
// Scenes after the figures of the papers on order-independent transparency: glass bars, frosted
// panes, fog, smoke among glass, shells, foliage and cloth.
#include <bench/scene_builder.hpp>
#include <bench/scene_parts.hpp>
#include <scene/mesh_shapes.hpp>
#include <scene/texture.hpp>

#include <algorithm>
#include <memory>

namespace brume::bench {
namespace {

scene::Scene makeGlassBars() {
    SceneBuilder b(dvec3(0, 0, 5), dvec3(0), 40);
    addDaylight(b.scene);
    b.scene.background.radiance = dvec3(0.9);
    const dvec3 colours[] = {{0.9, 0.1, 0.1}, {0.1, 0.8, 0.2}, {0.15, 0.3, 0.95},
                             {0.95, 0.85, 0.1}, {0.1, 0.85, 0.9}, {0.85, 0.15, 0.8}};
    for (int i = 0; i < 6; ++i) {
        const std::uint32_t glass = b.addThin(1, colours[i], dvec3(0.04));
        const double at = -1.5 + 0.6 * i;
        b.addPane(glass, {0.4, 3.4}, {at, 0, 0.4});
        b.addPane(glass, {4.4, 0.4}, {0, at, 0});
    }
    return b.scene;
}

scene::Scene makeFrostedPanes() {
    SceneBuilder b(dvec3(0, 1, 6), dvec3(0, 0.8, 0), 36);
    addDaylight(b.scene);
    b.scene.background.radiance = dvec3(0.35, 0.4, 0.5);
    b.addMesh(scene::makePlane(dvec2(30)), b.addOpaque({0.3, 0.28, 0.25}), dmat4(1));
    for (int i = 0; i < 5; ++i) {
        const double x = -2.4 + 1.2 * i;
        b.addPane(b.addThin(1, dvec3(0.92, 0.95, 0.95), dvec3(0.03), 1 - 0.25 * i), {1.1, 1.8},
                  {x, 0.95, 0.6});
        // One that touches the pane, one a little and one far behind it.
        const std::uint32_t red = b.addOpaque({0.8, 0.15, 0.1});
        b.addMesh(scene::makeSphere(0.18, 32), red, place({x - 0.3, 0.3, 0.41}));
        b.addMesh(scene::makeSphere(0.25, 32), b.addOpaque({0.15, 0.6, 0.2}),
                  place({x + 0.25, 0.8, -0.3}));
        b.addMesh(scene::makeSphere(0.35, 32), b.addOpaque({0.2, 0.25, 0.85}),
                  place({x, 1.5, -2.5}));
    }
    return b.scene;
}

scene::Scene makeFoggyStreet() {
    SceneBuilder b(dvec3(0, 1.7, 14), dvec3(0, 2.2, 0), 45);
    b.addAmbient(dvec3(0.02, 0.025, 0.04));
    b.scene.background.radiance = dvec3(0.01, 0.015, 0.03);
    b.addMesh(scene::makePlane(dvec2(60)), b.addOpaque({0.12, 0.12, 0.13}), dmat4(1));
    Random random(11);
    const std::uint32_t wall = b.addOpaque({0.25, 0.2, 0.18});
    const std::uint32_t pole = b.addOpaque({0.1, 0.1, 0.1});
    const std::uint32_t lamp = b.addOpaque(dvec3(0), {8, 6, 3.5});
    for (int i = 0; i < 5; ++i)
        for (const double side : {-1.0, 1.0}) {
            const double z = 8 - 6 * i, height = random.uniform(5, 9);
            b.addBox(wall, {3, height, 5}, {side * 5.5, height / 2, z});
            b.addBox(pole, {0.1, 3.4, 0.1}, {side * 3, 1.7, z - 3});
            b.addMesh(scene::makeSphere(0.16, 16), lamp, place({side * 3, 3.5, z - 3}));
            if (i < 3) b.addPoint({side * 3, 3.5, z - 3}, {9, 6.5, 3.5});
        }
    const std::uint32_t fog = b.addMedium(1, dvec3(0.95));
    for (int i = 0; i < 400; ++i)
        b.addSphere(fog, {random.uniform(-5, 5), random.uniform(0, 4), random.uniform(-24, 11)},
                    random.uniform(1.2, 2.6), random.uniform(0.01, 0.06));
    return b.scene;
}

scene::Scene makeSmokeAndGlass() {
    SceneBuilder b(dvec3(0, 1.2, 5), dvec3(0, 0.9, 0), 42);
    addDaylight(b.scene);
    b.scene.background.radiance = dvec3(0.5, 0.6, 0.75);
    b.addMesh(scene::makePlane(dvec2(20)), b.addOpaque({0.4, 0.38, 0.35}), dmat4(1));
    b.addBox(b.addOpaque({0.6, 0.2, 0.15}), {0.5, 1.4, 0.5}, {-0.6, 0.7, -0.6});
    b.addPane(b.addThin(1, {0.3, 0.85, 0.5}, dvec3(0.05)), {1.4, 1.8}, {-1, 0.95, 0.6}, 25);
    b.addPane(b.addThin(1, {0.95, 0.6, 0.2}, dvec3(0.05)), {1.4, 1.8}, {1, 0.95, 0.5}, -25);
    b.addMesh(scene::makeSphere(0.45, 32), b.addGlass({2.5, 0.5, 0.3}), place({0.2, 0.46, 0.9}));
    const std::uint32_t smoke = b.addMedium(3, {0.8, 0.78, 0.75});
    Random random(12);
    for (int i = 0; i < 300; ++i) {
        const double height = random.uniform(0, 2.2), spread = 0.25 + 0.4 * height;
        b.addSphere(smoke,
                    {0.5 + random.uniform(-spread, spread), height,
                     0.2 + random.uniform(-spread, spread)},
                    random.uniform(0.12, 0.35), random.uniform(0.2, 0.9));
    }
    return b.scene;
}

scene::Scene makePlume100k() {
    SceneBuilder b(dvec3(0, 1.5, 6), dvec3(0, 1.5, 0), 36);
    addDaylight(b.scene);
    b.scene.background.radiance = dvec3(0.25, 0.35, 0.55);
    const std::uint32_t smoke = b.addMedium(8, {0.75, 0.72, 0.7});
    Random random(13);
    for (int i = 0; i < 100'000; ++i) {
        const double height = 3.2 * std::pow(random.uniform(), 1.4);
        const double turn = 2.2 * height + random.uniform(0, 6.283);
        const double out = (0.08 + 0.25 * height) * std::sqrt(random.uniform());
        b.addSphere(smoke, {out * std::cos(turn) + 0.15 * height, height, out * std::sin(turn)},
                    0.015 + 0.02 * height, random.uniform(0.2, 1) / (0.3 + height));
    }
    return b.scene;
}

scene::Scene makeEngine() {
    SceneBuilder b(dvec3(2.2, 1.6, 3), dvec3(0), 36);
    addDaylight(b.scene);
    b.scene.background.radiance = dvec3(1);
    Random random(14);
    for (int i = 0; i < 60; ++i) {
        const dvec3 hue(random.uniform(0.1, 0.9), random.uniform(0.1, 0.9),
                        random.uniform(0.1, 0.9));
        const std::uint32_t metal = b.addThin(0.3, dvec3(0), hue);
        const dvec3 at(random.uniform(-0.8, 0.8), random.uniform(-0.5, 0.5),
                       random.uniform(-0.5, 0.5));
        if (i % 3 == 0)
            b.addMesh(scene::makeSphere(random.uniform(0.1, 0.4), 24), metal, place(at));
        else
            b.addMesh(scene::makeBox(dvec3(random.uniform(0.1, 0.8), random.uniform(0.1, 0.5),
                                           random.uniform(0.1, 0.5))),
                      metal, place(at, 90 * (i % 4)));
    }
    return b.scene;
}

/// A leaf: green, its alpha an ellipse.
std::shared_ptr<const scene::Texture> makeLeafTexture() {
    auto texture = std::make_shared<scene::Texture>();
    texture->name = "leaf";
    texture->width = texture->height = 32;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            const double u = (x - 15.5) / 15.5, v = (y - 15.5) / 15.5;
            const double r = std::hypot(u / (0.65 - 0.25 * v), v);
            const double alpha = std::clamp((1 - r) * 8, 0.0, 1.0);
            texture->texels.emplace_back(0.25 + 0.2 * v, 0.6 - 0.1 * std::abs(u), 0.15, alpha);
        }
    return texture;
}

/// A strip of `count` quads along a curve.
scene::Mesh makeRibbon(const dvec3& root, const dvec3& bend, double length, double width,
                       int count) {
    scene::Mesh mesh;
    for (int i = 0; i <= count; ++i) {
        const double s = double(i) / count;
        const dvec3 at = root + dvec3(0, -length * s, 0) + bend * (s * s);
        for (const double side : {-0.5, 0.5}) {
            mesh.positions.emplace_back(at + dvec3(side * width, 0, 0));
            mesh.normals.emplace_back(0, 0, 1);
            mesh.uvs.emplace_back(side + 0.5, s);
        }
        if (i == count) break;
        const auto first = static_cast<std::uint32_t>(2 * i);
        for (const std::uint32_t k : {0u, 2u, 1u, 1u, 2u, 3u}) mesh.indices.push_back(first + k);
    }
    return mesh;
}

scene::Scene makeMixed() {
    SceneBuilder b(dvec3(0, 1.1, 4.5), dvec3(0, 1, 0), 42);
    addDaylight(b.scene);
    b.scene.background.radiance = dvec3(0.55, 0.65, 0.8);
    b.addMesh(scene::makePlane(dvec2(20)), b.addOpaque({0.4, 0.36, 0.3}), dmat4(1));
    Random random(15);
    scene::Material leaf;
    leaf.type = scene::MaterialType::Thin;
    leaf.reflected = dvec3(1);
    leaf.colorTexture = makeLeafTexture();
    const std::uint32_t foliage = b.add(leaf);
    for (int i = 0; i < 60; ++i)
        b.addPane(foliage, dvec2(random.uniform(0.15, 0.35)),
                  {random.uniform(-1.9, -0.8), random.uniform(0.2, 1.9), random.uniform(-0.8, 0.8)},
                  random.uniform(-70, 70));
    const std::uint32_t hair = b.addThin(0.35, dvec3(0), {0.45, 0.25, 0.1});
    for (int i = 0; i < 150; ++i)
        b.addMesh(makeRibbon({random.uniform(0.5, 1.1), 1.9, random.uniform(-0.2, 0.2)},
                             {random.uniform(-0.3, 0.3), 0, random.uniform(-0.2, 0.3)},
                             random.uniform(0.8, 1.3), 0.012, 8),
                  hair, dmat4(1));
    b.addPane(b.addThin(1, {0.8, 0.9, 0.95}, dvec3(0.05)), {1.2, 1.8}, {-1.2, 1, 1}, 10);
    b.addPane(b.addThin(1, {0.95, 0.75, 0.5}, dvec3(0.05)), {0.9, 1.6}, {1.5, 0.9, -0.7}, -20);
    for (int i = 0; i < 3; ++i)
        b.addPane(b.addThin(0.4, dvec3(0.1), {0.8, 0.75, 0.85}), {0.9, 1.5},
                  {0.1 + 0.12 * i, 0.95, -0.5 + 0.3 * i}, 12 * i);
    const std::uint32_t smoke = b.addMedium(3, dvec3(0.7));
    for (int i = 0; i < 120; ++i)
        b.addSphere(smoke,
                    {random.uniform(-1.5, 1.5), random.uniform(0, 0.9), random.uniform(-0.8, 0.8)},
                    random.uniform(0.15, 0.4), random.uniform(0.05, 0.4));
    return b.scene;
}

/// A ball of hair: ribbons of half coverage that overlap a hundredfold at its rim.
scene::Scene makeFur() {
    SceneBuilder b(dvec3(0, 0, 4.2), dvec3(0, -0.2, 0), 36);
    addDaylight(b.scene);
    b.scene.background.radiance = dvec3(0.55, 0.65, 0.8);
    b.addMesh(scene::makeSphere(0.5, 32), b.addOpaque({0.3, 0.2, 0.12}), dmat4(1));
    Random random(16);
    scene::Mesh coats[3];
    for (int i = 0; i < 6000; ++i) {
        const double z = random.uniform(-1, 1), turn = random.uniform(0, 2 * kPi);
        const dvec3 out(std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z);
        const scene::Mesh hair = makeRibbon(0.5 * out, 0.5 * out + dvec3(0, 0.2, 0),
                                            random.uniform(0.2, 0.5), 0.006, 5);
        scene::Mesh& coat = coats[i % 3];
        const auto first = static_cast<std::uint32_t>(coat.positions.size());
        coat.positions.insert(coat.positions.end(), hair.positions.begin(), hair.positions.end());
        coat.normals.insert(coat.normals.end(), hair.normals.begin(), hair.normals.end());
        coat.uvs.insert(coat.uvs.end(), hair.uvs.begin(), hair.uvs.end());
        for (const std::uint32_t index : hair.indices) coat.indices.push_back(first + index);
    }
    for (int i = 0; i < 3; ++i)
        b.addMesh(std::move(coats[i]), b.addThin(0.5, dvec3(0), (0.5 + 0.25 * i) * dvec3(0.6, 0.4, 0.2)),
                  dmat4(1));
    return b.scene;
}

struct Maker {
    std::string_view name;
    scene::Scene (*make)();
};

constexpr Maker kMakers[] = {{"glass_bars", &makeGlassBars},
                             {"frosted_panes", &makeFrostedPanes},
                             {"foggy_street", &makeFoggyStreet},
                             {"smoke_and_glass", &makeSmokeAndGlass},
                             {"plume_100k", &makePlume100k},
                             {"engine", &makeEngine},
                             {"fur", &makeFur},
                             {"mixed", &makeMixed}};

}  // namespace

void addDaylight(scene::Scene& scene) {
    scene::Light ambient;
    ambient.color = dvec3(0.4, 0.45, 0.5);
    scene::Light sun;
    sun.type = scene::LightType::Directional;
    sun.color = dvec3(2, 1.9, 1.7);
    sun.direction = glm::normalize(dvec3(0.6, -0.7, -0.39));
    scene.lights = {ambient, sun};
}

std::optional<scene::Scene> makeTransparencyScene(std::string_view name) {
    for (const Maker& maker : kMakers)
        if (maker.name == name) return maker.make();
    return std::nullopt;
}

}  // namespace brume::bench
