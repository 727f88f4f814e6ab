// SPDX-License-Identifier: Apache-2.0
// Chess pieces of glass and their board.
#include "mesh_groups.hpp"

#include <array>

namespace brume::gallery {
namespace {

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

}  // namespace

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

}  // namespace brume::gallery
