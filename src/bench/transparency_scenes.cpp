// SPDX-License-Identifier: Apache-2.0
// Scenes after the figures of the papers on order-independent transparency: glass bars, frosted
// panes, fog, smoke among glass, shells, foliage and cloth.
#include <bench/scene_builder.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brume::bench {
namespace {

scene::Scene makeGlassBars() {
    Builder b(dvec3(0, 0, 5), dvec3(0), 40);
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
    Builder b(dvec3(0, 1.35, 6.2), dvec3(0, 0.85, 0), 36);
    b.addSky({0.25, 0.4, 0.7}, {0.75, 0.78, 0.8}, {0.2, 0.18, 0.16});
    const std::uint32_t frame = b.addOpaque({0.05, 0.045, 0.04});
    const std::uint32_t red = b.addOpaque({0.8, 0.1, 0.06}), green = b.addOpaque({0.1, 0.5, 0.16}),
                        blue = b.addOpaque({0.1, 0.2, 0.75});
    std::vector<dvec3> feet;
    for (int i = 0; i < 5; ++i) {
        const double x = -2.5 + 1.25 * i;
        b.addPane(b.addThin(1, dvec3(0.92, 0.95, 0.95), dvec3(0.03), 1 - 0.25 * i), {1.1, 1.7},
                  {x, 0.95, 0.6});
        b.addFrame(frame, {1.14, 1.74}, 0.05, {x, 0.95, 0.6});
        // One that touches the pane, one a little and one far behind it.
        b.addMesh(scene::makeSphere(0.18, 32), red, place({x - 0.28, 0.18, 0.41}));
        b.addMesh(scene::makeSphere(0.25, 32), green, place({x + 0.22, 0.25, -0.5}));
        b.addBox(blue, {0.3, 1.5, 0.3}, {x, 0.75, -2.5}, 30);
        feet.insert(feet.end(), {{x - 0.28, 0.41, 0.2}, {x + 0.22, -0.5, 0.28}, {x, -2.5, 0.35}});
    }
    b.addFloor(24, 0.5, {dvec3(0.75, 0.7, 0.62), dvec3(0.28, 0.2, 0.15)}, feet);
    return b.scene;
}

scene::Scene makeFoggyStreet() {
    Builder b(dvec3(0, 1.7, 14), dvec3(0, 2.2, 0), 45);
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

/// Smoke that rises from `root`, spreads and drifts along +x.
void addColumn(Builder& b, std::uint32_t medium, Random& random, const dvec3& root, double height,
               int count) {
    for (int i = 0; i < count; ++i) {
        const double rise = height * std::pow(random.uniform(), 1.3);
        const double spread = 0.1 + 0.28 * rise;
        const dvec3 at(root.x + 0.18 * rise * rise + spread * random.uniform(-1, 1),
                       root.y + rise, root.z + spread * random.uniform(-1, 1));
        const dvec3 drift = 0.22 * rise * dvec3(noiseAt(at * 2.0), 0, noiseAt(at * 2.0 + 40.0));
        b.addSphere(medium, at + drift, random.uniform(0.08, 0.16) + 0.1 * rise,
                    random.uniform(0.4, 1.2) / (0.5 + rise));
    }
}

scene::Scene makeSmokeAndGlass() {
    Builder b(dvec3(0.2, 1.35, 5.2), dvec3(0, 0.95, 0), 40);
    b.addSky({0.12, 0.25, 0.55}, {0.8, 0.75, 0.7}, {0.2, 0.17, 0.14});
    const std::uint32_t frame = b.addOpaque({0.04, 0.04, 0.045});
    b.addBox(b.addOpaque({0.65, 0.12, 0.08}), {0.45, 1.5, 0.45}, {-0.75, 0.75, -0.7}, 20);
    b.addPane(b.addShiny({0.3, 0.85, 0.5}), {1.3, 1.8}, {-1.05, 0.97, 0.5}, 25);
    b.addFrame(frame, {1.34, 1.84}, 0.05, {-1.05, 0.97, 0.5}, 25);
    b.addPane(b.addShiny({0.95, 0.6, 0.2}), {1.3, 1.8}, {1.15, 0.97, 0.45}, -25);
    b.addFrame(frame, {1.34, 1.84}, 0.05, {1.15, 0.97, 0.45}, -25);
    b.addMesh(scene::makeSphere(0.4, 48), b.addGlass({2.5, 0.6, 0.25}, 0.05),
              place({-0.05, 0.4, 1.1}));
    const dvec3 feet[] = {{-0.75, -0.7, 0.5}, {-0.05, 1.1, 0.35}, {0.5, 0.1, 0.4}};
    b.addFloor(24, 0.6, {dvec3(0.55, 0.52, 0.48), dvec3(0.3, 0.28, 0.27)}, feet);
    const ShadedSmoke smoke = b.beginSmoke(9, {0.95, 0.93, 0.9});
    Random random(12);
    addColumn(b, smoke.firstMedium, random, {0.5, 0.05, 0.1}, 2.2, 400);
    b.shadeSmoke(smoke);
    return b.scene;
}

/// Billows around a line that the wind bends: balls whose particles are dense at the skin.
scene::Scene makePlume100k() {
    Builder b(dvec3(-0.9, 1.3, 7), dvec3(0.45, 1.85, 0), 36);
    b.addSky({0.08, 0.14, 0.34}, {0.85, 0.55, 0.35}, {0.06, 0.05, 0.05});
    const dvec2 chimney[] = {{0.24, -2}, {0.17, 0}, {0.2, 0.02}, {0.2, 0.1}, {0.13, 0.1}, {0.12, -1}};
    b.addMesh(makeLathe(chimney, 32), b.addOpaque({0.3, 0.14, 0.1}));
    const ShadedSmoke smoke = b.beginSmoke(14, {0.98, 0.95, 0.92});
    Random random(13);
    constexpr int kBillows = 160, kParticles = 100'000;
    for (int billow = 0; billow < kBillows; ++billow) {
        const double rise = 3.3 * std::pow((billow + 0.5) / kBillows, 1.2);
        const double radius = (0.1 + 0.17 * rise) * random.uniform(0.7, 1.2);
        const double angle = 2.4 * billow, out = (0.03 + 0.16 * rise) * random.uniform(0.3, 1);
        const dvec3 center(0.16 * rise * rise + out * std::cos(angle), 0.08 + rise,
                           out * std::sin(angle));
        for (int i = 0; i < kParticles / kBillows; ++i) {
            const double z = random.uniform(-1, 1), turn = random.uniform(0, 2 * std::numbers::pi);
            const double flat = std::sqrt(1 - z * z);
            const dvec3 direction(flat * std::cos(turn), z, flat * std::sin(turn));
            const double bump = 1 + 0.35 * noiseAt(direction * 3.0 + dvec3(billow));
            b.addSphere(smoke.firstMedium,
                        center + direction * (radius * bump * std::cbrt(random.uniform(0.15, 1))),
                        0.02 + 0.02 * rise, random.uniform(0.3, 1) / (0.4 + 2 * rise));
        }
    }
    b.shadeSmoke(smoke);
    return b.scene;
}

/// Sixty shells: six cylinders over a crankshaft, seen through each other.
scene::Scene makeEngine() {
    Builder b(dvec3(2.5, 1.5, 3.2), dvec3(0, -0.02, 0), 33);
    b.addSky({0.5, 0.55, 0.62}, {0.95, 0.95, 0.95}, {0.55, 0.55, 0.57});
    const auto addMetal = [&](const dvec3& colour, double coverage) {
        return b.addThin(coverage, dvec3(0), colour);
    };
    const std::uint32_t steel = addMetal({0.45, 0.5, 0.58}, 0.22),
                        dark = addMetal({0.12, 0.14, 0.18}, 0.4),
                        copper = addMetal({0.75, 0.35, 0.15}, 0.5),
                        brass = addMetal({0.8, 0.62, 0.2}, 0.5),
                        red = addMetal({0.75, 0.08, 0.05}, 0.55),
                        blue = addMetal({0.08, 0.25, 0.6}, 0.35);
    const auto addTube = [&](std::uint32_t metal, double radius, double low, double high, double x) {
        const dvec2 profile[] = {{0, low}, {radius, low}, {radius, high}, {0, high}};
        b.addMesh(makeLathe(profile, 32), metal, place({x, 0, 0}));
    };
    for (int i = 0; i < 6; ++i) {
        const double x = -1 + 0.4 * i, stroke = 0.14 * std::cos(2.1 * i);
        addTube(steel, 0.18, -0.25, 0.42, x);
        addTube(copper, 0.155, 0.02 + stroke, 0.2 + stroke, x);
        addTube(dark, 0.16, 0.14 + stroke, 0.155 + stroke, x);
        b.addMesh(makeRod({x, -0.5 + stroke, 0.12 * std::sin(2.1 * i)}, {x, 0.06 + stroke, 0}, 0.035),
                  brass);
        b.addMesh(makeRod({x - 0.07, 0.36, 0.05}, {x - 0.12, 0.62, 0.16}, 0.025), blue);
        b.addMesh(makeRod({x + 0.07, 0.36, -0.05}, {x + 0.12, 0.62, -0.16}, 0.025), red);
        b.addMesh(makeRod({x, 0.4, 0}, {x, 0.68, 0}, 0.03), brass);
        b.addMesh(makeRod({x, -0.5 + stroke, -0.14}, {x, -0.5 + stroke, 0.14}, 0.1), dark);
    }
    b.addBox(steel, {2.5, 0.5, 0.62}, {0, -0.5, 0});
    b.addBox(blue, {2.3, 0.26, 0.5}, {0, -0.86, 0});
    b.addBox(steel, {2.5, 0.14, 0.5}, {0, 0.5, 0});
    b.addBox(red, {2.4, 0.16, 0.44}, {0, 0.68, 0});
    b.addMesh(makeRod({-1.5, -0.5, 0}, {1.5, -0.5, 0}, 0.06), steel);
    for (const double side : {-1.0, 1.0})
        b.addMesh(makeRod({-1.1, 0.62, 0.18 * side}, {1.1, 0.62, 0.18 * side}, 0.04), dark);
    b.addMesh(makeRod({-1.1, 0.3, 0.42}, {1.1, 0.3, 0.42}, 0.1), blue);
    b.addMesh(makeRod({-1.1, 0.25, -0.42}, {1.1, 0.25, -0.42}, 0.09), copper);
    b.addMesh(makeRod({1.32, -0.5, 0}, {1.42, -0.5, 0}, 0.3), dark);
    b.addMesh(makeRod({1.32, 0.1, 0.22}, {1.42, 0.1, 0.22}, 0.16), brass);
    b.addMesh(makeRod({-1.42, -0.5, 0}, {-1.32, -0.5, 0}, 0.34), dark);
    return b.scene;
}

/// A leaf: green with a pale rib, its alpha pointed at both ends.
std::shared_ptr<const scene::Texture> makeLeafTexture() {
    return paintTexture("leaf", 64, 64, [](double u, double v) {
        const double x = 2 * u - 1, width = 0.55 * std::sin(std::numbers::pi * std::pow(v, 0.8));
        const double alpha = std::clamp((width - std::abs(x)) * 16, 0.0, 1.0);
        const double rib = std::exp(-900 * x * x) +
                           0.4 * std::pow(std::abs(std::sin(26 * (v + 0.35 * std::abs(x)))), 24.0);
        const dvec3 green = glm::mix(dvec3(0.09, 0.3, 0.05), dvec3(0.3, 0.5, 0.12), v);
        return dvec4(glm::mix(green, dvec3(0.5, 0.6, 0.25), std::min(0.6 * rib, 0.6)), alpha);
    });
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

/// Cloth that hangs in folds, `size` wide and high, its upper edge at `at`.
scene::Mesh makeCloth(const dvec2& size, const dvec3& at) {
    constexpr int kColumns = 64, kRows = 16;
    scene::Mesh mesh;
    for (int row = 0; row <= kRows; ++row)
        for (int column = 0; column <= kColumns; ++column) {
            const double u = double(column) / kColumns, v = double(row) / kRows;
            const double phase = 30 * u + 1.5 * std::sin(5 * u) + 0.8 * v;
            const double depth = 0.02 + 0.05 * v;
            mesh.positions.emplace_back(
                at + dvec3((u - 0.5) * size.x, -v * size.y, depth * std::sin(phase)));
            mesh.normals.emplace_back(
                glm::normalize(dvec3(-depth * 30 / size.x * std::cos(phase), 0, 1)));
            mesh.uvs.emplace_back(u, v);
            if (row == kRows || column == kColumns) continue;
            const auto first = static_cast<std::uint32_t>(row * (kColumns + 1) + column);
            for (const std::uint32_t k :
                 {0u, kColumns + 1u, 1u, 1u, kColumns + 1u, kColumns + 2u})
                mesh.indices.push_back(first + k);
        }
    return mesh;
}

/// Stems out of a pot, with leaves on cards.
void addPlant(Builder& b, Random& random, const dvec3& at) {
    const dvec2 pot[] = {{0.0, 0}, {0.2, 0}, {0.28, 0.42}, {0.3, 0.42}, {0.3, 0.48}, {0.25, 0.48},
                         {0.24, 0.44}, {0, 0.44}};
    b.addMesh(makeLathe(pot, 48), b.addOpaque({0.5, 0.2, 0.1}), place(at));
    scene::Material leaf;
    leaf.type = scene::MaterialType::Thin;
    leaf.reflected = dvec3(1);
    leaf.colorTexture = makeLeafTexture();
    const std::uint32_t foliage = b.add(leaf), bark = b.addOpaque({0.14, 0.18, 0.07});
    for (int stem = 0; stem < 12; ++stem) {
        const double yaw = 137.5 * stem, bend = random.uniform(0.15, 0.55);
        const dvec3 out(std::sin(radians(yaw)), 0, std::cos(radians(yaw)));
        const double height = random.uniform(0.7, 1.35) - 0.5 * bend;
        const auto pointAt = [&](double s) {
            return at + dvec3(0, 0.42 + height * s, 0) + out * (0.06 + bend * s * s);
        };
        for (int i = 0; i < 4; ++i)
            b.addMesh(makeRod(pointAt(i / 4.0), pointAt((i + 1) / 4.0), 0.008), bark);
        for (int i = 0; i < 7; ++i) {
            const double size = random.uniform(0.16, 0.3);
            dmat4 card = place(pointAt(0.3 + 0.1 * i), yaw + (i % 2 ? 70 : -70),
                               random.uniform(35, 75));
            card = card * place({0, 0, 0.5 * size});
            b.addMesh(scene::makePlane({size, size}), foliage, card);
        }
    }
}

scene::Scene makeMixed() {
    Builder b(dvec3(0, 1.25, 4.6), dvec3(0, 0.95, 0), 40);
    b.addSky({0.2, 0.38, 0.7}, {0.85, 0.82, 0.76}, {0.25, 0.22, 0.18});
    Random random(15);
    const std::uint32_t wood = b.addOpaque({0.22, 0.12, 0.06});
    addPlant(b, random, {-1.15, 0, 0});
    b.addPane(b.addShiny({0.8, 0.9, 0.95}), {1.3, 1.9}, {-1.2, 1, 0.95}, 8);
    b.addFrame(wood, {1.34, 1.94}, 0.06, {-1.2, 1, 0.95}, 8);
    // A clothes rail with a sheer curtain in three layers and strands of hair.
    b.addMesh(makeRod({-0.4, 1.95, 0}, {1.9, 1.95, 0}, 0.025), wood);
    for (const double x : {-0.35, 1.85}) b.addMesh(makeRod({x, 0, 0}, {x, 1.95, 0}, 0.025), wood);
    const std::uint32_t cloth = b.addThin(0.45, dvec3(0.15), {0.85, 0.7, 0.75});
    for (int i = 0; i < 3; ++i)
        b.addMesh(makeCloth({0.85, 1.6}, {0.15 + 0.1 * i, 1.93, -0.12 + 0.12 * i}), cloth);
    const std::uint32_t hair = b.addThin(0.4, dvec3(0), {0.4, 0.2, 0.08});
    for (int i = 0; i < 220; ++i)
        b.addMesh(makeRibbon({random.uniform(0.95, 1.65), 1.94, random.uniform(-0.08, 0.08)},
                             {random.uniform(-0.22, 0.22), 0, random.uniform(-0.1, 0.2)},
                             random.uniform(0.9, 1.35), 0.012, 8),
                  hair);
    b.addPane(b.addShiny({0.95, 0.7, 0.35}), {0.9, 1.6}, {1.6, 0.85, -0.9}, -20);
    b.addFrame(wood, {0.94, 1.64}, 0.05, {1.6, 0.85, -0.9}, -20);
    const dvec3 feet[] = {{-1.15, 0, 0.4}, {-0.35, 0, 0.12}, {1.85, 0, 0.12}};
    b.addFloor(24, 0.5, {dvec3(0.5, 0.4, 0.3), dvec3(0.38, 0.28, 0.2)}, feet);
    const ShadedSmoke smoke = b.beginSmoke(6, dvec3(0.93, 0.93, 0.95));
    addColumn(b, smoke.firstMedium, random, {-0.45, 0, -0.7}, 1.9, 260);
    addColumn(b, smoke.firstMedium, random, {0.45, 0, 0.7}, 0.8, 160);
    b.shadeSmoke(smoke);
    return b.scene;
}

/// A ball of hair: ribbons of half coverage that overlap a hundredfold at its rim.
scene::Scene makeFur() {
    Builder b(dvec3(0, 0, 4.2), dvec3(0, -0.2, 0), 36);
    addDaylight(b.scene);
    b.scene.background.radiance = dvec3(0.55, 0.65, 0.8);
    b.addMesh(scene::makeSphere(0.5, 32), b.addOpaque({0.3, 0.2, 0.12}));
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
        b.addMesh(std::move(coats[i]), b.addThin(0.5, dvec3(0), (0.5 + 0.25 * i) * dvec3(0.6, 0.4, 0.2)));
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
