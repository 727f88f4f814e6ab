// SPDX-License-Identifier: Apache-2.0
#include <bench/hard_builder.hpp>
#include <bench/volume_scenes.hpp>

namespace brume::bench {

namespace {

float ballDensity(const ivec3& voxel) {
    const auto r2 = static_cast<float>(voxel.x * voxel.x + voxel.y * voxel.y + voxel.z * voxel.z);
    return std::max(1 - r2 / 36, 0.0f);
}

NamedScene makeVolumeScene(const char* name, const dmat4& worldFromIndex,
                           float (*density)(const ivec3& voxel)) {
    HardBuilder b;
    scene::Volume volume;
    volume.medium = b.addMedium(2, dvec3(0.9, 0.6, 0.3));
    NamedScene named = b.named(name);
    named.volumes.emplace_back(volume, makeBrickGrid(worldFromIndex, 1, density));
    return named;
}

}  // namespace

/// A map that mirrors and shears: optical depths scale with true lengths, front and back stay.
NamedScene makeShearedVolume() {
    dmat4 map = glm::scale(glm::rotate(dmat4(1), 0.5, dvec3(0, 1, 0)), dvec3(-0.14, 0.1, 0.12));
    map[1][0] += 0.05;
    return makeVolumeScene("hard_sheared_volume", map, &ballDensity);
}

/// A sheet one voxel thick, on edge and aslant: long steps miss it.
NamedScene makeSheetVolume() {
    const dmat4 map =
        glm::scale(glm::rotate(dmat4(1), 1.3, dvec3(0.1, 1, 0.2)), dvec3(0.14));
    return makeVolumeScene("hard_sheet_volume", map, [](const ivec3& v) {
        return v.x == 0 && std::abs(v.y) < 6 && std::abs(v.z) < 6 ? 4.0f : 0.0f;
    });
}

/// Voxels over twelve decades.
NamedScene makeDynamicRange() {
    return makeVolumeScene("hard_dynamic_range", glm::scale(dmat4(1), dvec3(0.14)),
                           [](const ivec3& v) {
                               if (ballDensity(v) == 0) return 0.0f;
                               return static_cast<float>(std::pow(10.0, v.x));
                           });
}

/// Nothing to draw is no error, and no volume of zero size.
NamedScene makeEmptyVolume() {
    HardBuilder b;
    scene::Volume volume;
    volume.medium = b.addMedium(2, dvec3(0.9, 0.6, 0.3));
    b.addBall(volume.medium, dvec3(0), 0.7, 0.5);
    NamedScene named = b.named("hard_empty_volume");
    named.volumes.emplace_back(volume, makeBrickGrid(dmat4(1), 1, [](const ivec3&) { return 0.0f; }));
    return named;
}

/// As dense voxels the tile would take 256 GiB. It begins behind the ball's bricks.
NamedScene makeHugeTile() {
    NamedScene named =
        makeVolumeScene("hard_huge_tile", glm::scale(dmat4(1), dvec3(0.1)), &ballDensity);
    named.volumes.front().second.boxes.push_back(
        {.lo = dvec3(-2048, -2048, -4105), .hi = dvec3(2048, 2048, -9), .value = 2e-3f});
    return named;
}

/// Between them a dense grid would be 8e18 voxels long.
NamedScene makeFarVoxels() {
    NamedScene named =
        makeVolumeScene("hard_far_voxels", glm::scale(dmat4(1), dvec3(0.14)), &ballDensity);
    volumes::VolumeGrid& grid = named.volumes.front().second;
    volumes::Brick far = grid.bricks.front();
    far.origin = ivec3(-1'000'000, 3, -2'000'000);
    grid.bricks.push_back(far);
    return named;
}

NamedScene makeTinyVolume() {
    constexpr double kVoxel = 2e-5;
    NamedScene named =
        makeVolumeScene("hard_tiny_voxels", glm::scale(dmat4(1), dvec3(kVoxel)), &ballDensity);
    named.scene.camera.position = dvec3(0, 0, 30 * kVoxel);
    named.scene.camera.near = kVoxel;
    named.scene.media.front().extinction = dvec3(0.3 / kVoxel);
    return named;
}

}  // namespace brume::bench
