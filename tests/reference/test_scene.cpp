// SPDX-License-Identifier: Apache-2.0
#include <reference/test_scene.hpp>

#include <algorithm>

namespace brume::reference {

void TestScene::addPane(std::uint32_t material, double z, double halfSize) {
    scene::Mesh mesh;
    const auto s = static_cast<float>(halfSize), h = static_cast<float>(z);
    mesh.positions = {{-s, -s, h}, {s, -s, h}, {s, s, h}, {-s, s, h}};
    mesh.normals.assign(4, vec3(0, 0, -1));
    mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.indices = {0, 2, 1, 0, 3, 2};
    mesh.material = material;
    scene.meshes.push_back(mesh);
}

void TestScene::addClosedBox(std::uint32_t material, const dvec3& lo, const dvec3& hi,
                             const dmat4& worldFromObject) {
    scene::Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.emplace_back(i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z);
    // Counter-clockwise seen from outside.
    mesh.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                    2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    mesh.material = material;
    mesh.worldFromObject = worldFromObject;
    scene.meshes.push_back(mesh);
}

void fillBricks(volumes::VolumeGrid& grid, int bricks,
                const std::function<float(const ivec3&)>& value) {
    using namespace volumes;
    for (int z = 0; z < bricks; ++z)
        for (int y = 0; y < bricks; ++y)
            for (int x = 0; x < bricks; ++x) {
                Brick brick;
                brick.origin = kBrickCells * ivec3(x, y, z);
                brick.valueOffset = static_cast<std::uint32_t>(grid.values.size());
                for (int k = 0; k < kBrickValues; ++k)
                    for (int j = 0; j < kBrickValues; ++j)
                        for (int i = 0; i < kBrickValues; ++i) {
                            grid.values.push_back(value(brick.origin + ivec3(i, j, k)));
                            brick.maxValue = std::max(brick.maxValue, grid.values.back());
                        }
                grid.bricks.push_back(brick);
            }
}

void BruteForce::integrate(const std::function<Local(long double t)>& at,
                           std::vector<double> breaks, int stepsPerInterval) {
    std::sort(breaks.begin(), breaks.end());
    for (std::size_t i = 1; i < breaks.size(); ++i) {
        const long double a = breaks[i - 1], length = breaks[i] - a;
        if (!(length > 0)) continue;
        long double from = 0;
        for (int step = 1; step <= stepsPerInterval; ++step) {
            const long double u = static_cast<long double>(step) / stepsPerInterval;
            const long double to = u * u * u * u;
            const long double h = (to - from) * length;
            const Local local = at(a + 0.5L * (from + to) * length);
            const long double depth = local.extinction * h;
            if (local.extinction > 0)
                radiance += transmittance * local.light / local.extinction * -std::expm1(-depth);
            else
                radiance += transmittance * local.light * h;
            transmittance *= std::exp(-depth);
            from = to;
        }
    }
}

}  // namespace brume::reference
