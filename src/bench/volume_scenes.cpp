// SPDX-License-Identifier: Apache-2.0
#include <bench/scene_builder.hpp>
#include <bench/scene_parts.hpp>
#include <bench/volume_scenes.hpp>
#include <volumes/box_decomposition.hpp>

#include <regex>

namespace brume::bench {

volumes::VolumeGrid makeBrickGrid(const dmat4& worldFromIndex, int n,
                                  const std::function<float(const ivec3& voxel)>& density) {
    volumes::VolumeGrid grid;
    grid.name = "density";
    grid.worldFromIndex = worldFromIndex;
    for (int b = 0; b < 8 * n * n * n; ++b) {
        volumes::Brick brick;
        brick.origin =
            volumes::kBrickCells * (ivec3(b % (2 * n), b / (2 * n) % (2 * n), b / (4 * n * n)) - n);
        brick.valueOffset = static_cast<std::uint32_t>(grid.values.size());
        for (int k = 0; k < volumes::kBrickValues; ++k)
            for (int j = 0; j < volumes::kBrickValues; ++j)
                for (int i = 0; i < volumes::kBrickValues; ++i) {
                    const float value = density(brick.origin + ivec3(i, j, k));
                    grid.values.push_back(value);
                    brick.maxValue = std::max(brick.maxValue, value);
                }
        if (brick.maxValue > 0)
            grid.bricks.push_back(brick);
        else
            grid.values.resize(brick.valueOffset);
    }
    return grid;
}

namespace {

/// A ball of that radius with waves, falling off to its rim.
float cloudDensity(const ivec3& voxel, double voxels) {
    const dvec3 p = dvec3(voxel) / voxels;
    const double fall = std::max(1 - glm::dot(p, p), 0.0);
    const double waves = std::sin(9 * p.x) * std::sin(8 * p.y + 1) * std::sin(7 * p.z + 2);
    return static_cast<float>(fall * std::max(0.6 + waves, 0.0));
}

/// A ball of 1 m of smoke, in 8^3 bricks n to each side of its middle.
void addCloud(int n, Builder& b, NamedScene& named,
              const std::function<void(volumes::VolumeGrid&)>& change) {
    const double voxels = volumes::kBrickCells * n - 2;
    volumes::VolumeGrid grid =
        makeBrickGrid(glm::scale(dmat4(1), dvec3(1 / voxels)), n,
                      [voxels](const ivec3& voxel) { return cloudDensity(voxel, voxels); });
    scene::Volume volume;
    volume.medium = b.addMedium(3, dvec3(0.9));
    if (change) change(grid);
    named.scene = std::move(b.scene);
    named.volumes.emplace_back(volume, std::move(grid));
}

Builder makeCloudScene() {
    Builder b(dvec3(0, 0, 4), dvec3(0), 36);
    b.scene.background.radiance = dvec3(0.2, 0.3, 0.5);
    addDaylight(b.scene);
    return b;
}

}  // namespace

NamedScene makeShadowedCloud() {
    Builder b = makeCloudScene();
    for (scene::Light& light : b.scene.lights)
        if (light.type == scene::LightType::Directional) light.shadow = "visibility";
    NamedScene named{"shadowed_cloud", {}};
    addCloud(6, b, named, {});
    return named;
}

std::optional<NamedScene> makeBoxesScene(const std::string& name) {
    static const std::regex kName("boxes_(\\d{1,5})");
    std::smatch part;
    if (!std::regex_match(name, part, kName)) return std::nullopt;
    Builder b = makeCloudScene();
    NamedScene named{name, {}};
    addCloud(3, b, named, [&part](volumes::VolumeGrid& grid) {
        if (const int thousandths = std::stoi(part[1]); thousandths > 0)
            volumes::convertToBoxes(grid, 3, 1e-3 * thousandths);
    });
    return named;
}

}  // namespace brume::bench
