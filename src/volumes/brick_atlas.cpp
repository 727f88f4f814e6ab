// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <volumes/brick_atlas.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace brume::volumes {
namespace {

/// A multiple of 8 near the middle, so that moved bricks still start at multiples of 8.
ivec3 chooseAnchor(const VolumeGrid& grid) {
    if (grid.isEmpty()) return ivec3(0);
    const dvec3 middle = grid.indexBounds().center() / static_cast<double>(kBrickCells);
    return ivec3(glm::floor(middle)) * kBrickCells;
}

void checkSize(std::span<const VolumeGrid> volumes) {
    std::uint64_t values = 0;
    for (const VolumeGrid& grid : volumes) values += grid.bricks.size() * kBrickValueCount;
    if (values > 0xffffffffu)
        throw failure("packing volumes", "",
                      fmt::format("{} brick values are needed, at most {} can be addressed", values,
                                  0xffffffffu));
}

void packVolume(const VolumeGrid& grid, BrickAtlas& atlas) {
    AtlasVolume volume;
    const auto number = static_cast<std::uint32_t>(atlas.volumes.size());
    volume.anchor = chooseAnchor(grid);
    volume.worldFromIndex = glm::translate(grid.worldFromIndex, dvec3(volume.anchor));
    volume.firstBrick = static_cast<std::uint32_t>(atlas.bricks.size());
    volume.brickCount = static_cast<std::uint32_t>(grid.bricks.size());
    volume.firstBox = static_cast<std::uint32_t>(atlas.boxes.size());
    volume.boxCount = static_cast<std::uint32_t>(grid.boxes.size());
    for (const Brick& brick : grid.bricks) {
        const auto offset = static_cast<std::uint32_t>(atlas.values.size());
        const auto first = grid.values.begin() + brick.valueOffset;
        atlas.values.insert(atlas.values.end(), first, first + kBrickValueCount);
        atlas.bricks.push_back({brick.origin - volume.anchor, brick.maxValue, offset, number});
        volume.maxValue = std::max(volume.maxValue, brick.maxValue);
    }
    for (const ValueBox& box : grid.boxes) {
        const dvec3 anchor(volume.anchor);
        atlas.boxes.push_back(
            {vec3(box.lo - anchor), box.value, vec3(box.hi - anchor), box.soft ? 1u : 0u, number});
        volume.maxValue = std::max(volume.maxValue, box.value);
    }
    if (!grid.bricks.empty()) {
        const auto hash = buildBrickHash(grid);
        volume.firstEntry = static_cast<std::uint32_t>(atlas.entries.size());
        volume.entryCount = static_cast<std::uint32_t>(hash.size());
        atlas.entries.insert(atlas.entries.end(), hash.begin(), hash.end());
    }
    atlas.volumes.push_back(volume);
}

}  // namespace

std::size_t BrickAtlas::bytes() const {
    return values.size() * sizeof(float) + bricks.size() * sizeof(AtlasBrick) +
           boxes.size() * sizeof(AtlasBox) + entries.size() * sizeof(BrickIndex::Entry) +
           volumes.size() * sizeof(AtlasVolume);
}

BrickAtlas packBricks(std::span<const VolumeGrid> volumes) {
    checkSize(volumes);
    BrickAtlas atlas;
    std::size_t bricks = 0;
    for (const VolumeGrid& grid : volumes) bricks += grid.bricks.size();
    atlas.values.reserve(bricks * kBrickValueCount);
    atlas.bricks.reserve(bricks);
    for (const VolumeGrid& grid : volumes) packVolume(grid, atlas);
    return atlas;
}

}  // namespace brume::volumes
