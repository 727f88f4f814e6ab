// SPDX-License-Identifier: Apache-2.0
#include "volumes.hpp"

#include "noise.hpp"

#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <tbb/parallel_for.h>

#include <functional>
#include <random>
#include <string>
#include <vector>

namespace brume::gallery {
namespace {

/// What two or three grids of a file hold at one place.
using Values = vec3;
using Sculpture = std::function<Values(vec3 position)>;

struct Space {
    vec3 lo, hi;  ///< m
    float voxel;  ///< m
};

/// Samples a sculpture and writes one grid for each name, in 16-bit floats. Values below 1/500 of
/// a grid's scale are left out, so that bricks of nothing cost nothing.
void writeSculpture(const std::filesystem::path& file, const Space& space,
                    const std::vector<std::string>& names, const Sculpture& sculpture) {
    const openvdb::Coord size(openvdb::Vec3i(int((space.hi.x - space.lo.x) / space.voxel),
                                             int((space.hi.y - space.lo.y) / space.voxel),
                                             int((space.hi.z - space.lo.z) / space.voxel)));
    const openvdb::CoordBBox box(openvdb::Coord(0), size);
    using Dense = openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ>;
    std::vector<Dense> values;
    for (std::size_t i = 0; i < names.size(); ++i) values.emplace_back(box, 0.0f);
    tbb::parallel_for(0, size.z() + 1, [&](int z) {
        for (int y = 0; y <= size.y(); ++y)
            for (int x = 0; x <= size.x(); ++x) {
                const Values v = sculpture(space.lo + space.voxel * vec3(x, y, z));
                for (std::size_t i = 0; i < names.size(); ++i)
                    values[i].setValue(openvdb::Coord(x, y, z), v[static_cast<int>(i)]);
            }
    });
    openvdb::GridPtrVec grids;
    const auto transform = openvdb::math::Transform::createLinearTransform(double(space.voxel));
    transform->postTranslate(openvdb::Vec3d(space.lo.x, space.lo.y, space.lo.z));
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto grid = openvdb::FloatGrid::create(0.0f);
        openvdb::tools::copyFromDense(values[i], *grid, 0.002f);
        grid->setName(names[i]);
        grid->setTransform(transform);
        grid->setGridClass(openvdb::GRID_FOG_VOLUME);
        grid->setSaveFloatAsHalf(true);
        grids.push_back(grid);
    }
    openvdb::io::File(file.string()).write(grids);
}

struct Ball {
    vec3 center;
    float radius;
};

/// How deep a place lies in a union of balls that melt into each other: 1 in the middle, 0 at the
/// surface, negative outside.
float depthIn(const std::vector<Ball>& balls, vec3 p) {
    float sum = 0;
    for (const Ball& ball : balls)
        sum += std::exp(12 * (1 - glm::distance(p, ball.center) / ball.radius));
    return std::log(sum + 1e-9f) / 12;
}

/// A cumulus, 4.4 m wide and 2.4 m high; scenes scale it up. Towers of balls on a flat base,
/// eroded by cells within cells.
Sculpture sculptCloud() {
    std::mt19937 random(7);
    const auto uniform = [&](float a, float b) {
        return a + (b - a) * static_cast<float>(random() >> 8) * 0x1p-24f;
    };
    std::vector<Ball> balls;
    for (const vec3 tower : {vec3(-0.5f, 1.75f, 0), vec3(0.65f, 1.25f, 0.2f),
                             vec3(-1.35f, 0.85f, -0.1f), vec3(1.45f, 0.7f, 0)})
        for (int i = 0; i < 11; ++i) {
            const float up = uniform(0, 1), wide = (1 - 0.62f * up) * 0.62f;
            balls.push_back(
                {{tower.x + uniform(-wide, wide), up * tower.y, tower.z + uniform(-wide, wide)},
                 (0.52f - 0.24f * up) * uniform(0.75f, 1.15f)});
        }
    return [balls](vec3 p) {
        const vec3 q = warped(p, 0.5f, 0.10f, 2, 3);
        const float lumps = 1 - cells(q * 2.6f, 1), knobs = 1 - cells(q * 6.1f, 5),
                    curls = fractal(q * 9.0f, 4, 9);
        const float shape =
            depthIn(balls, q) + 0.42f * (lumps - 0.55f) + 0.22f * (knobs - 0.5f) + 0.16f * curls;
        const float base = rise(-0.18f, 0.02f, p.y + 0.06f * fractal(p * 2.0f, 3, 21));
        return Values(base * rise(0.02f, 0.30f, shape) * (0.75f + 0.5f * lumps), 0, 0);
    };
}

struct Tongue {
    vec2 root;
    vec2 lean;
    float height, radius;
    std::uint32_t seed;
};

/// 1 in the middle of a tongue of fire, 0 at its edge, negative outside.
float depthIn(const Tongue& tongue, vec3 p) {
    const float h = p.y / tongue.height;
    if (h < 0 || h > 1) return -1;
    const float lick = 0.34f * h * tongue.radius;
    const vec3 stretched(p.x * 3.2f, p.y * 2.1f, p.z * 3.2f);
    const vec2 sway(fractal(stretched, 3, tongue.seed), fractal(stretched, 3, tongue.seed + 9));
    const vec2 axis = tongue.root + tongue.lean * (h * h) + 4.5f * lick * sway;
    const float profile = std::pow(h + 0.06f, 0.35f) * std::pow(1 - h, 0.85f) * 1.35f;
    return 1 - glm::distance(vec2(p.x, p.z), axis) / (tongue.radius * profile + 1e-4f);
}

/// Fire (flame: the orange envelope, core: its white heart) and the smoke that rises from it.
Sculpture sculptCampfire() {
    const std::vector<Tongue> tongues = {{{0, 0}, {0.10f, 0}, 1.75f, 0.30f, 1},
                                         {{-0.22f, 0.08f}, {0.16f, -0.06f}, 1.25f, 0.22f, 31},
                                         {{0.24f, 0.02f}, {-0.06f, 0.05f}, 1.35f, 0.22f, 61},
                                         {{0.04f, 0.24f}, {-0.10f, -0.10f}, 0.95f, 0.21f, 91},
                                         {{-0.08f, -0.22f}, {0.0f, 0.1f}, 1.1f, 0.2f, 121},
                                         {{0.38f, 0.18f}, {0.05f, -0.02f}, 0.62f, 0.14f, 151},
                                         {{-0.4f, -0.02f}, {0.02f, 0.02f}, 0.72f, 0.15f, 181}};
    return [tongues](vec3 p) {
        float depth = -1;
        for (const Tongue& tongue : tongues) depth = std::max(depth, depthIn(tongue, p));
        const float streaks =
            ridges(vec3(p.x * 5.0f, p.y * 1.7f, p.z * 5.0f) +
                       1.2f * vec3(fractal(p * 2.5f, 2, 7), 0, fractal(p * 2.5f, 2, 8)),
                   3, 40);
        const float flame = rise(0, 0.35f, depth) * (0.25f + 1.1f * streaks);
        const float core =
            rise(0.3f, 0.8f, depth) * rise(1.2f, 0.2f, p.y) * (0.4f + 0.8f * streaks);
        // Smoke: a column that begins in the fire, widens and leans with the wind.
        const float up = p.y - 0.6f;
        const vec3 q = warped(p, 0.55f, 0.34f * glm::clamp(up, 0.1f, 1.6f), 4, 70);
        const float wide = 0.20f + 0.24f * std::max(up, 0.0f);
        const float off = glm::distance(vec2(q.x, q.z), vec2(0.14f, -0.03f) * up * up) / wide;
        const float smoke = rise(0.0f, 0.9f, up) * rise(1.0f, 0.25f, off) *
                            (0.2f + 1.6f * billow(q * 3.0f, 4, 80)) * rise(4.2f, 2.4f, p.y);
        return Values(flame, core, smoke);
    };
}

/// A ball of burning fuel that has just been thrown up: soot outside, fire in its furrows.
Sculpture sculptExplosion() {
    const std::vector<Ball> balls = {
        {{0, 1.7f, 0}, 1.15f},          {{-0.75f, 1.35f, 0.2f}, 0.8f},  {{0.8f, 1.4f, 0.1f}, 0.78f},
        {{0.25f, 2.35f, -0.1f}, 0.75f}, {{-0.45f, 2.25f, 0.1f}, 0.62f}, {{0, 0.75f, 0.1f}, 0.75f},
        {{1.45f, 0.95f, 0}, 0.46f},     {{-1.45f, 0.8f, 0.1f}, 0.5f},   {{0.1f, 0.25f, 0}, 0.75f},
        {{0.75f, 0.3f, 0.3f}, 0.42f},   {{-0.8f, 0.28f, 0.3f}, 0.45f}};
    return [balls](vec3 p) {
        const vec3 q = warped(p, 0.8f, 0.16f, 3, 5);
        const float lumps = 1 - cells(q * 1.9f, 11), knobs = 1 - cells(q * 4.3f, 17);
        const float bumps = 0.5f * lumps + 0.3f * knobs + 0.3f * billow(q * 5.0f, 4, 23);
        const float shape = depthIn(balls, q) + 0.75f * (bumps - 0.52f);
        const float soot = rise(0.0f, 0.13f, shape) * (0.5f + bumps);
        // Hot where the bumps are low and the surface is near: fresh fuel burns in the furrows.
        const float furrow = rise(0.53f, 0.31f, bumps + 0.10f * fractal(p * 1.5f, 2, 31));
        const float low = rise(2.9f, 0.3f, p.y);
        const float heat = rise(0.0f, 0.08f, shape) * furrow * (0.35f + low);
        return Values(soot * (1 - 0.85f * glm::clamp(heat, 0.0f, 1.0f)), heat,
                      heat * furrow * rise(0.35f, 1.0f, low * furrow));
    };
}

/// Air with smoke in it: veils and filaments in a box of 1 m, thinner towards its faces.
Sculpture sculptHaze() {
    return [](vec3 p) {
        const vec3 q = warped(p, 0.35f, 0.16f, 4, 3);
        const float veils = 0.5f + 0.5f * fractal(q * vec3(3.0f, 5.0f, 3.0f), 4, 13);
        const float strands = ridges(q * vec3(3.4f, 5.5f, 3.4f), 4, 23);
        const vec3 off = glm::abs(p) * 2.0f;
        const float edge = rise(1, 0.86f, off.x) * rise(1, 0.86f, off.y) * rise(1, 0.86f, off.z);
        return Values(edge * (0.25f + 0.8f * veils * veils + 0.9f * strands), 0, 0);
    };
}

/// Glowing gas in two colours and the dust before it, in a box of 2 x 1.2 x 1 m.
Sculpture sculptNebula() {
    return [](vec3 p) {
        const vec3 q = warped(warped(p, 0.7f, 0.38f, 4, 3), 0.22f, 0.09f, 3, 33);
        const vec3 off = p / vec3(0.95f, 0.56f, 0.45f);
        const float round = rise(1.0f, 0.25f, glm::length(off));
        const float gas = round * (ridges(q * 2.1f, 5, 13) * 1.7f +
                                   0.35f * rise(0.1f, 0.6f, fractal(q * 1.6f, 4, 43)));
        const float hot = rise(0.75f, 0.05f, glm::length(p - vec3(0.18f, 0.05f, 0))) * gas;
        const float dust = rise(1.0f, 0.4f, glm::length(off * vec3(1, 0.95f, 1))) *
                           rise(0.12f, 0.34f, fractal(q * 2.4f + 3.0f, 5, 63)) *
                           rise(0.03f, 0.22f, glm::length(p - vec3(0.18f, 0.05f, 0)) - 0.1f);
        return Values(gas, hot, dust);
    };
}

}  // namespace

void writeVolumes(const std::filesystem::path& folder, float detail) {
    openvdb::initialize();
    const auto space = [&](vec3 lo, vec3 hi, float voxel) { return Space{lo, hi, voxel / detail}; };
    writeSculpture(folder / "cloud.vdb", space({-2.3f, -0.25f, -1.1f}, {2.4f, 2.4f, 1.2f}, 0.018f),
                   {"density"}, sculptCloud());
    writeSculpture(folder / "campfire.vdb", space({-0.9f, 0, -0.9f}, {1.9f, 4.2f, 0.9f}, 0.02f),
                   {"flame", "core", "density"}, sculptCampfire());
    writeSculpture(folder / "explosion.vdb", space({-2.3f, 0, -1.5f}, {2.3f, 3.4f, 1.6f}, 0.022f),
                   {"density", "flame", "core"}, sculptExplosion());
    writeSculpture(folder / "haze.vdb", space(vec3(-0.5f), vec3(0.5f), 0.018f), {"density"},
                   sculptHaze());
    writeSculpture(folder / "nebula.vdb", space({-1, -0.6f, -0.5f}, {1, 0.6f, 0.5f}, 0.009f),
                   {"gas", "hot", "dust"}, sculptNebula());
}

}  // namespace brume::gallery
