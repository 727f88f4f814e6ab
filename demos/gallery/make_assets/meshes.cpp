// SPDX-License-Identifier: Apache-2.0
#include "mesh_groups.hpp"
#include "noise.hpp"

namespace brume::gallery {
namespace {

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
    writeStreet(folder);
    writeRocks(folder);
    writeCliff(folder);
    writeConifer(folder);
    writeIndoors(folder);
}

}  // namespace brume::gallery
