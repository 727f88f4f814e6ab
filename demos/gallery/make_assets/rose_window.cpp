// SPDX-License-Identifier: Apache-2.0
// A rose window of coloured glass in a wall of stone.
#include "mesh_groups.hpp"
#include "noise.hpp"

#include <array>

namespace brume::gallery {
namespace {

/// A piece of a ring in the plane z = 0 that faces +z.
void addSector(Shape& shape, float inner, float outer, float from, float to) {
    const int steps = std::max(2, static_cast<int>(std::ceil((to - from) * 24)));
    for (int i = 0; i < steps; ++i) {
        const float a = from + (to - from) * static_cast<float>(i) / static_cast<float>(steps);
        const float b = from + (to - from) * static_cast<float>(i + 1) / static_cast<float>(steps);
        if (inner > 0)
            shape.addQuad(onCircle(inner, a), onCircle(outer, a), onCircle(outer, b),
                          onCircle(inner, b));
        else
            shape.addTriangle(vec3(0), onCircle(outer, a), onCircle(outer, b));
    }
}

void addStrip(Shape& shape, vec3 a, vec3 b, float width) {
    const vec3 side = width * 0.5f * glm::normalize(glm::cross(vec3(0, 0, 1), b - a));
    shape.addQuad(a - side, b - side, b + side, a + side);
}

/// A wall of stone with a round hole of radius 1.6 m, 0.35 m thick, splayed outwards.
Shape makeWall() {
    Shape wall;
    const float hole = 1.6f, splayed = 1.85f, half = 15, back = -0.35f;
    for (int i = 0; i < 96; ++i) {
        const float a = kTurn * static_cast<float>(i) / 96,
                    b = kTurn * static_cast<float>(i + 1) / 96;
        const auto out = [&](float t, float z) {
            const vec3 d = onCircle(1, t);
            return d * (half / std::max(std::abs(d.x), std::abs(d.y))) + vec3(0, 0, z);
        };
        wall.addQuad(onCircle(hole, a), out(a, 0), out(b, 0), onCircle(hole, b));
        wall.addQuad(out(a, back), onCircle(splayed, a, back), onCircle(splayed, b, back),
                     out(b, back));
        wall.addQuad(onCircle(splayed, a, back), onCircle(hole, a), onCircle(hole, b),
                     onCircle(splayed, b, back));
    }
    return wall;
}

}  // namespace

void writeWindow(const std::filesystem::path& folder) {
    const vec3 hues[] = {{0.86f, 0.035f, 0.05f}, {0.035f, 0.12f, 0.88f}, {0.98f, 0.68f, 0.07f},
                         {0.04f, 0.62f, 0.22f},  {0.46f, 0.06f, 0.74f},  {0.10f, 0.62f, 0.88f}};
    std::vector<Part> parts;
    for (int hue = 0; hue < 6; ++hue)
        for (int shade = 0; shade < 3; ++shade)
            parts.push_back({{.name = "glass_" + std::to_string(hue) + "_" + std::to_string(shade),
                              .color = glm::pow(hues[hue], vec3(0.7f + 0.3f * float(shade))),
                              .transmission = 0.96f},
                             {}});
    Shape lead;
    struct Ring {
        float inner, outer;
        int petals, across, along;
        std::array<int, 2> hue;
    };
    // Each petal is a mosaic of `across` x `along` pieces in shades of its hue.
    const Ring rings[] = {{0, 0.26f, 6, 1, 1, {2, 2}},      {0.26f, 0.42f, 12, 1, 1, {0, 1}},
                          {0.42f, 0.92f, 12, 2, 4, {1, 0}}, {0.92f, 1.06f, 24, 1, 1, {2, 3}},
                          {1.06f, 1.44f, 12, 3, 3, {4, 1}}, {1.44f, 1.6f, 36, 1, 1, {0, 5}}};
    int piece = 0;
    for (const Ring& ring : rings) {
        addSector(lead, ring.outer - 0.016f, ring.outer + 0.016f, 0, kTurn);
        const float wide = kTurn / static_cast<float>(ring.petals);
        for (int p = 0; p < ring.petals; ++p) {
            const float from = wide * (static_cast<float>(p) + 0.5f);
            addStrip(lead, onCircle(std::max(ring.inner, 0.01f), from), onCircle(ring.outer, from),
                     0.03f);
            for (int i = 0; i < ring.across; ++i)
                for (int k = 0; k < ring.along; ++k) {
                    const auto cut = [](float a, float b, int j, int n) {
                        return a + (b - a) * static_cast<float>(j) / static_cast<float>(n);
                    };
                    const float a0 = cut(from, from + wide, i, ring.across),
                                a1 = cut(from, from + wide, i + 1, ring.across);
                    const float r0 = cut(ring.inner, ring.outer, k, ring.along),
                                r1 = cut(ring.inner, ring.outer, k + 1, ring.along);
                    const std::uint32_t dice = hashOf({++piece, 0, 0}, 5);
                    int hue = ring.hue[static_cast<std::size_t>(p % 2)];
                    if (ring.along > 1 && dice % 7 == 0) hue = 5;
                    if (ring.along > 2 && k == ring.along / 2) hue = 2;
                    addSector(parts[static_cast<std::size_t>(hue * 3 + int(dice / 7 % 3))].shape,
                              r0, r1, a0, a1);
                    if (k > 0) addSector(lead, r0 - 0.006f, r0 + 0.006f, a0, a1);
                    if (i > 0) addStrip(lead, onCircle(r0, a0), onCircle(r1, a0), 0.012f);
                }
        }
    }
    // Lead before and behind the glass, then the wall around it.
    Shape both = lead.moved({0, 0, 0.012f});
    both.add(lead.moved({0, 0, -0.012f}));
    std::erase_if(parts, [](const Part& part) { return part.shape.indices.empty(); });
    parts.push_back({{.name = "lead", .color = vec3(0.02f)}, both});
    parts.push_back(
        {{.name = "stone", .color = vec3(0.24f, 0.21f, 0.18f)}, makeWall().moved({0, 0, 0.2f})});
    writeGlb(folder / "window.glb", parts);
}

}  // namespace brume::gallery
