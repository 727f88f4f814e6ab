// SPDX-License-Identifier: Apache-2.0
// A street at night: houses, a lamp and someone under an umbrella.
#include "mesh_groups.hpp"
#include "noise.hpp"

#include <cstdint>

namespace brume::gallery {
namespace {

/// Someone in a long coat under an umbrella, 1.75 m tall.
void writeFigure(const std::filesystem::path& folder) {
    Shape coat = revolve({{0.0f, 0.42f},
                          {0.25f, 0.42f},
                          {0.25f, 0.42f},
                          {0.215f, 0.75f},
                          {0.17f, 1.02f},
                          {0.205f, 1.25f},
                          {0.215f, 1.36f},
                          {0.17f, 1.45f},
                          {0.07f, 1.49f},
                          {0.06f, 1.53f},
                          {0.0f, 1.53f}},
                         32);
    for (vec3& p : coat.positions) p.z *= 0.68f;
    coat.add(
        makeBall(24, [](vec3 d) { return vec3(0, 1.635f, 0) + d * vec3(0.098f, 0.125f, 0.11f); }));
    for (const float side : {-1.0f, 1.0f})
        coat.add(
            revolve(
                {{0, 0}, {0.075f, 0}, {0.055f, 0.09f}, {0.07f, 0.3f}, {0.085f, 0.5f}, {0, 0.5f}},
                16)
                .moved({side * 0.10f, 0, side * 0.07f}));
    // The arm that holds the umbrella, and its other.
    coat.add(makeSurface(16, 8, [](float u, float v) {
        const vec3 axis = glm::mix(vec3(0.2f, 1.36f, 0), vec3(0.23f, 1.12f, 0.22f), v);
        return axis + 0.06f * vec3(std::cos(kTurn * u), 0, -std::sin(kTurn * u));
    }));
    coat.add(makeSurface(16, 8, [](float u, float v) {
        const vec3 axis = glm::mix(vec3(-0.21f, 1.36f, 0), vec3(-0.26f, 0.82f, 0.02f), v);
        return axis + 0.055f * vec3(std::cos(kTurn * u), 0, -std::sin(kTurn * u));
    }));
    Shape umbrella = makeSurface(64, 12, [](float u, float v) {
        const float scallop = 1 - 0.06f * v * std::abs(std::sin(4 * kTurn * u * 0.5f * 2));
        const float r = 0.62f * std::sin(v * 1.25f) * scallop;
        return vec3(0.12f + r * std::cos(kTurn * u), 1.72f + 0.36f * std::cos(v * 1.35f),
                    0.1f + r * std::sin(kTurn * u));
    });
    umbrella.add(revolve({{0.012f, 1.0f}, {0.012f, 2.13f}}, 8).moved({0.12f + 0.08f, 0, 0.18f}));
    writeGlb(folder / "figure.glb",
             {{{.name = "coat", .color = vec3(0.03f, 0.03f, 0.035f)}, coat},
              {{.name = "umbrella", .color = vec3(0.16f, 0.02f, 0.02f)}, umbrella}});
}

/// A house front of 7 m that faces +x, its foot at the origin.
void addHouse(std::vector<Part>& parts, vec3 at, float side, int floors, std::uint32_t seed) {
    enum { kWall, kTrim, kDark, kLit, kWarm };
    const float depth = 5, wide = 7, high = 1.0f + 3.1f * static_cast<float>(floors);
    const auto box = [&](int part, vec3 center, vec3 size) {
        parts[static_cast<std::size_t>(part)].shape.add(
            makeBox(at + vec3(side * center.x, center.y, center.z), size));
    };
    box(kWall, {-depth / 2, high / 2, 0}, {depth, high, wide});
    box(kTrim, {0.05f, high - 0.12f, 0}, {0.5f, 0.3f, wide});
    box(kTrim, {0.02f, 3.45f, 0}, {0.24f, 0.16f, wide});
    for (int floor = 0; floor < floors; ++floor)
        for (int i = 0; i < 3; ++i) {
            const float y = 2.1f + 3.1f * static_cast<float>(floor),
                        z = -2.2f + 2.2f * static_cast<float>(i);
            const std::uint32_t dice = hashOf({floor, i, int(at.z)}, seed);
            if (floor == 0 && i == int(seed % 3)) {
                box(kDark, {0.01f, 1.15f, z}, {0.06f, 2.3f, 1.1f});
                box(kTrim, {0.05f, 2.42f, z}, {0.2f, 0.14f, 1.4f});
                continue;
            }
            box(dice % 4 == 0   ? kLit
                : dice % 9 == 0 ? kWarm
                                : kDark,
                {0.005f, y, z}, {0.04f, 1.6f, 1.05f});
            box(kTrim, {0.03f, y - 0.86f, z}, {0.22f, 0.1f, 1.4f});
            box(kTrim, {0.03f, y + 0.86f, z}, {0.14f, 0.1f, 1.3f});
            box(kTrim, {0.035f, y, z}, {0.05f, 1.6f, 0.06f});
            box(kTrim, {0.035f, y + 0.2f, z}, {0.05f, 0.06f, 1.05f});
        }
}

void writeHouses(const std::filesystem::path& folder) {
    std::vector<Part> parts = {
        {{.name = "wall", .color = vec3(0.17f, 0.13f, 0.11f)}, {}},
        {{.name = "trim", .color = vec3(0.24f, 0.22f, 0.2f)}, {}},
        {{.name = "dark", .color = vec3(0.015f, 0.018f, 0.025f)}, {}},
        {{.name = "lit", .color = vec3(0.1f), .emission = vec3(1.5f, 0.85f, 0.32f)}, {}},
        {{.name = "warm", .color = vec3(0.1f), .emission = vec3(0.5f, 0.2f, 0.06f)}, {}},
        {{.name = "kerb", .color = vec3(0.15f, 0.15f, 0.155f)}, {}}};
    for (int i = 0; i < 7; ++i)
        for (const float side : {-1.0f, 1.0f}) {
            const std::uint32_t seed = hashOf({i, int(side), 0}, 2);
            addHouse(parts, {side * 5.6f, 0, 6 - 7 * static_cast<float>(i)}, -side,
                     2 + int(seed % 3), seed / 8);
        }
    for (const float side : {-1.0f, 1.0f})
        parts[5].shape.add(makeBox({side * 4.5f, 0.07f, -16}, {2.4f, 0.14f, 60}));
    writeGlb(folder / "street.glb", parts);
}

/// A lamp: its post stands at the origin, its arm reaches 1 m along +x to a shade at 4.1 m.
void writeLamp(const std::filesystem::path& folder) {
    Shape post = revolve(
        {{0.16f, 0}, {0.16f, 0.3f}, {0.16f, 0.3f}, {0.07f, 0.5f}, {0.05f, 2}, {0.045f, 4.3f}}, 16);
    post.add(makeSurface(12, 16, [](float u, float v) {
        const float bend = v * kTurn / 4;
        const vec3 axis(1.0f - 1.0f * std::cos(bend), 4.3f + 0.25f * std::sin(bend), 0);
        return axis + 0.035f * vec3(std::cos(kTurn * u) * -std::sin(bend * 0.4f),
                                    std::cos(kTurn * u), std::sin(kTurn * u));
    }));
    post.add(revolve({{0.24f, 4.2f}, {0.22f, 4.32f}, {0.1f, 4.46f}, {0.03f, 4.6f}}, 24)
                 .moved({1, 0, 0}));
    const Shape bulb =
        makeBall(16, [](vec3 d) { return vec3(1, 4.24f, 0) + d * vec3(0.13f, 0.09f, 0.13f); });
    writeGlb(folder / "lamp.glb",
             {{{.name = "iron", .color = vec3(0.02f)}, post},
              {{.name = "bulb", .color = vec3(0), .emission = vec3(14, 9.4f, 4.6f)}, bulb}});
}

}  // namespace

void writeStreet(const std::filesystem::path& folder) {
    writeFigure(folder);
    writeHouses(folder);
    writeLamp(folder);
}

}  // namespace brume::gallery
