// SPDX-License-Identifier: Apache-2.0
#include "meshes.hpp"

#include "noise.hpp"
#include "shape.hpp"

#include <array>
#include <numbers>

namespace brume::gallery {
namespace {

constexpr float kTurn = 2 * std::numbers::pi_v<float>;

vec3 onCircle(float radius, float angle, float z = 0) {
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

// --- Chess ---------------------------------------------------------------------------------------

/// Foot and stem that all pieces share, up to `height`, then what is on top.
Shape makePiece(float radius, float height, const Outline& top) {
    const float r = radius;
    Outline line = {{0, 0},
                    {0.92f * r, 0},
                    {0.92f * r, 0},
                    {r, 0.05f},
                    {r, 0.10f},
                    {0.88f * r, 0.15f},
                    {0.88f * r, 0.15f},
                    {0.84f * r, 0.20f},
                    {0.62f * r, 0.26f},
                    {0.62f * r, 0.26f},
                    {0.46f * r, 0.38f},
                    {0.34f * r, 0.3f + 0.45f * (height - 0.3f)},
                    {0.34f * r, height}};
    line.push_back(line.back());
    line.insert(line.end(), top.begin(), top.end());
    return revolve(line, 64);
}

/// A ball of the given radius on a neck of radius `neck`, up to the pole.
void addBall(Outline& line, float center, float radius, float neck) {
    const float from = -std::acos(neck / radius);
    for (int i = 0; i <= 8; ++i) {
        const float a = from + (kTurn / 4 - from) * static_cast<float>(i) / 8;
        line.emplace_back(i == 8 ? 0.0f : radius * std::cos(a), center + radius * std::sin(a));
    }
}

void writeChess(const std::filesystem::path& folder) {
    const auto write = [&](const char* name, const Shape& shape) {
        writeGlb(folder / name, {{{.name = "glass"}, shape}});
    };
    Outline pawn = {{0.23f, 0.70f}, {0.24f, 0.73f}, {0.23f, 0.76f},
                    {0.23f, 0.76f}, {0.10f, 0.79f}, {0.10f, 0.79f}};
    addBall(pawn, 0.945f, 0.19f, 0.10f);
    write("pawn.glb", makePiece(0.34f, 0.69f, pawn));
    write("rook.glb", makePiece(0.38f, 0.78f,
                                {{0.27f, 0.80f},
                                 {0.28f, 0.83f},
                                 {0.26f, 0.86f},
                                 {0.26f, 0.86f},
                                 {0.24f, 0.92f},
                                 {0.27f, 0.98f},
                                 {0.27f, 0.98f},
                                 {0.285f, 1.0f},
                                 {0.285f, 1.19f},
                                 {0.285f, 1.19f},
                                 {0.20f, 1.19f},
                                 {0.20f, 1.19f},
                                 {0.18f, 1.05f},
                                 {0.18f, 1.05f},
                                 {0, 1.05f}}));
    Outline bishop = {{0.25f, 1.02f}, {0.26f, 1.05f}, {0.25f, 1.08f},  {0.25f, 1.08f},
                      {0.13f, 1.12f}, {0.13f, 1.12f}, {0.19f, 1.22f},  {0.205f, 1.32f},
                      {0.16f, 1.46f}, {0.07f, 1.58f}, {0.045f, 1.61f}, {0.045f, 1.61f}};
    addBall(bishop, 1.66f, 0.065f, 0.045f);
    write("bishop.glb", makePiece(0.38f, 1.0f, bishop));
    Outline queen = {{0.27f, 1.22f},  {0.28f, 1.25f}, {0.27f, 1.28f}, {0.27f, 1.28f},
                     {0.15f, 1.33f},  {0.15f, 1.33f}, {0.18f, 1.50f}, {0.285f, 1.74f},
                     {0.285f, 1.74f}, {0.24f, 1.73f}, {0.24f, 1.73f}, {0.15f, 1.80f},
                     {0.05f, 1.83f},  {0.05f, 1.83f}};
    addBall(queen, 1.90f, 0.08f, 0.05f);
    write("queen.glb", makePiece(0.41f, 1.20f, queen));
    Outline king = {{0.29f, 1.36f}, {0.30f, 1.40f}, {0.29f, 1.43f}, {0.29f, 1.43f},
                    {0.17f, 1.48f}, {0.17f, 1.48f}, {0.20f, 1.66f}, {0.28f, 1.90f},
                    {0.28f, 1.90f}, {0.22f, 1.97f}, {0, 2.03f}};
    Shape whole = makePiece(0.43f, 1.34f, king);
    // The cross: a plus sign, thick enough to be seen; it stands free by a hair.
    const float w = 0.045f, y = 2.036f, d = 0.045f;
    const std::array<vec2, 12> plus = {{{-w, 0},
                                        {w, 0},
                                        {w, 0.13f},
                                        {0.13f, 0.13f},
                                        {0.13f, 0.22f},
                                        {w, 0.22f},
                                        {w, 0.33f},
                                        {-w, 0.33f},
                                        {-w, 0.22f},
                                        {-0.13f, 0.22f},
                                        {-0.13f, 0.13f},
                                        {-w, 0.13f}}};
    for (std::size_t i = 0; i < plus.size(); ++i) {
        const vec2 a = plus[i], b = plus[(i + 1) % plus.size()];
        whole.addQuad({a.x, y + a.y, d}, {a.x, y + a.y, -d}, {b.x, y + b.y, -d}, {b.x, y + b.y, d});
    }
    for (const std::array<std::size_t, 4> q : {std::array<std::size_t, 4>{0, 1, 2, 11},
                                               {11, 2, 5, 8},
                                               {8, 5, 6, 7},
                                               {2, 3, 4, 5},
                                               {10, 11, 8, 9}})
        for (const float z : {d, -d}) {
            const auto at = [&](int k) {
                const vec2 p = plus[q[static_cast<std::size_t>(z > 0 ? k : 3 - k)]];
                return vec3(p.x, y + p.y, z);
            };
            whole.addQuad(at(0), at(1), at(2), at(3));
        }
    write("king.glb", whole);
    Shape light, dark;
    for (int x = 0; x < 8; ++x)
        for (int z = 0; z < 8; ++z) {
            const vec3 c(static_cast<float>(x) - 3.5f, 0, static_cast<float>(z) - 3.5f);
            ((x + z) % 2 ? light : dark)
                .addQuad(c + vec3(-.5f, 0, .5f), c + vec3(.5f, 0, .5f), c + vec3(.5f, 0, -.5f),
                         c + vec3(-.5f, 0, -.5f));
        }
    const Shape frame = makeBox({0, -0.155f, 0}, {9, 0.3f, 9});
    writeGlb(folder / "board.glb",
             {{{.name = "light", .color = vec3(0.80f, 0.76f, 0.69f)}, light},
              {{.name = "dark", .color = vec3(0.075f, 0.07f, 0.075f)}, dark},
              {{.name = "frame", .color = vec3(0.16f, 0.075f, 0.035f)}, frame}});
}

// --- The rose window -----------------------------------------------------------------------------

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

// --- The street ----------------------------------------------------------------------------------

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

void writeStreet(const std::filesystem::path& folder) {
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

    // A lamp: its post stands at the origin, its arm reaches 1 m along +x to a shade at 4.1 m.
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

// --- Outdoors ------------------------------------------------------------------------------------

void writeRocks(const std::filesystem::path& folder) {
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
        const Shape rock = makeBall(64, [&](vec3 d) {
            // Flattened where planes cut it, as stone breaks.
            float r = 1;
            for (int i = 0; i < 14; ++i) {
                const vec3 n =
                    glm::normalize(vec3(uniformOf({i, 0, 0}, seed), uniformOf({i, 1, 0}, seed),
                                        uniformOf({i, 2, 0}, seed)) -
                                   0.5f);
                const float reach = 0.68f + 0.25f * uniformOf({i, 3, 0}, seed),
                            along = glm::dot(d, n);
                if (along > 0.01f) r = std::min(r, reach / along);
            }
            return d * (r + 0.05f * fractal(d * 3.0f, 5, seed * 9));
        });
        writeGlb(folder / ("rock_" + std::to_string(seed) + ".glb"),
                 {{{.name = "rock", .color = vec3(0.20f, 0.18f, 0.16f)}, rock}});
    }
}

/// A cliff of 30 x 12 m in the plane z = 0 that faces +z, with a cleft in its middle.
void writeCliff(const std::filesystem::path& folder) {
    const Shape cliff = makeSurface(170, 84, [](float u, float v) {
        const float x = 30 * (u - 0.5f), y = 12 * v - 0.5f;
        const vec3 q(x * 0.35f, y * 0.16f, 0);
        float z = 1.7f * ridges(q, 3, 4) + 0.9f * fractal(vec3(x * 0.7f, y * 0.5f, 2), 5, 7);
        const float ledge = y * 0.75f + 0.5f * fractal(vec3(x * 0.3f, y * 0.3f, 5), 3, 17);
        z += 0.75f * rise(0.25f, 0.8f, ledge - std::floor(ledge)) - 0.22f * y;
        z -= 1.9f * std::exp(-x * x / 2.4f);               // the cleft
        z += 0.055f * x * x * rise(1.5f, 9, std::abs(x));  // walls to both sides
        return vec3(x, y, z);
    });
    writeGlb(folder / "cliff.glb",
             {{{.name = "cliff", .color = vec3(0.135f, 0.13f, 0.115f)}, cliff}});
}

/// A conifer, 1 m tall.
void writeConifer(const std::filesystem::path& folder) {
    Shape tree = revolve({{0.018f, 0}, {0.012f, 0.5f}}, 8);
    for (int tier = 0; tier < 11; ++tier) {
        const float low = 0.1f + 0.077f * static_cast<float>(tier), wide = 0.23f * (1.04f - low);
        tree.add(makeSurface(40, 2, [&](float u, float v) {
            const float a = kTurn * (u - std::floor(u));
            const float branch =
                0.62f +
                0.75f * std::abs(noise(
                            vec3(std::cos(a) * 3.1f, float(tier) * 1.7f, std::sin(a) * 3.1f), 3)) +
                0.20f * std::sin(13 * a + float(tier));
            const float r = wide * (1 - v) * branch;
            return vec3(r * std::cos(a), low + (0.13f + 0.4f * wide) * v - 0.12f * r,
                        -r * std::sin(a));
        }));
    }
    writeGlb(folder / "conifer.glb",
             {{{.name = "conifer", .color = vec3(0.045f, 0.075f, 0.04f)}, tree}});
}

// --- Indoors -------------------------------------------------------------------------------------

void writeIndoors(const std::filesystem::path& folder) {
    Shape leaves;
    for (int i = 0; i < 26; ++i) {
        const auto dice = [&](int k) { return uniformOf({i, k, 0}, 77); };
        const float heading = kTurn * (static_cast<float>(i) * 0.381966f),
                    reach = 0.28f + 0.34f * dice(1), high = 0.55f + 0.75f * dice(2);
        const float droop = 0.25f + 0.5f * dice(3), wide = 0.035f + 0.035f * dice(4);
        const vec3 out(std::cos(heading), 0, std::sin(heading)), side(-out.z, 0, out.x);
        leaves.add(makeSurface(4, 18, [&](float u, float v) {
            const vec3 spine = out * (reach * v * v) + vec3(0, high * v * (1 - droop * v * v), 0);
            const float w = wide *
                            std::pow(std::max(std::sin(kTurn / 2 * (0.06f + 0.94f * v)), 0.0f),
                                     0.8f),
                        s = 2 * u - 1;
            return spine + side * (w * s) + vec3(0, 0.3f * w * std::abs(s), 0);
        }));
    }
    const Shape pot = revolve({{0, -0.3f},
                               {0.12f, -0.3f},
                               {0.12f, -0.3f},
                               {0.16f, 0.0f},
                               {0.175f, 0.0f},
                               {0.175f, 0.05f},
                               {0.175f, 0.05f},
                               {0.15f, 0.05f},
                               {0.15f, 0},
                               {0, 0}},
                              32);
    writeGlb(folder / "plant.glb", {{{.name = "leaf", .color = vec3(0.07f, 0.24f, 0.05f)}, leaves},
                                    {{.name = "pot", .color = vec3(0.5f, 0.2f, 0.1f)}, pot}});

    // A curtain of 1 x 1 m in the plane z = 0, in folds that open towards its foot.
    const Shape curtain = makeSurface(160, 24, [](float u, float v) {
        const float open = 1 - 0.45f * v,
                    fold = std::sin(kTurn * (7 * u + 0.15f * std::sin(kTurn * 2.3f * u + 2 * v)));
        return vec3((u - 0.5f) * (0.86f + 0.14f * open), v,
                    0.055f * open * fold + 0.02f * noise(vec3(u * 5, v * 2, 1)));
    });
    writeGlb(folder / "curtain.glb", {{{.name = "cloth", .color = vec3(0.8f)}, curtain}});
    writeGlb(folder / "vase.glb", {{{.name = "glass"},
                                    revolve({{0, 0},
                                             {0.09f, 0},
                                             {0.09f, 0},
                                             {0.17f, 0.1f},
                                             {0.18f, 0.22f},
                                             {0.11f, 0.36f},
                                             {0.06f, 0.46f},
                                             {0.085f, 0.54f},
                                             {0.085f, 0.54f},
                                             {0, 0.53f}},
                                            64)}});
}

}  // namespace

void writeMeshes(const std::filesystem::path& folder) {
    writeChess(folder);
    writeWindow(folder);
    writeFigure(folder);
    writeStreet(folder);
    writeRocks(folder);
    writeCliff(folder);
    writeConifer(folder);
    writeIndoors(folder);
}

}  // namespace brume::gallery
