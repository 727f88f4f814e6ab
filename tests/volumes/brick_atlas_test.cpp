// SPDX-License-Identifier: Apache-2.0
// The flat arrays for upload say the same as the grids.
#include <volumes/brick_atlas.hpp>
#include <volumes/support.hpp>

namespace brume::volumes::test {
namespace {

std::uint32_t findInAtlas(const BrickAtlas& atlas, const AtlasVolume& volume, const ivec3& coord) {
    const std::uint32_t mask = volume.entryCount - 1;
    for (std::uint32_t slot = hashBrick(coord) & mask;; slot = (slot + 1) & mask) {
        const BrickIndex::Entry& entry = atlas.entries[volume.firstEntry + slot];
        if (entry.brick == BrickIndex::kNone || entry.coord == coord) return entry.brick;
    }
}

TEST(PackBricks_SeveralVolumes, KeepsValuesPlacesAndTables) {
    std::vector<VolumeGrid> grids;
    grids.push_back(buildVolume(makeNoise(1, 9), "a", dmat4(1)));
    grids.push_back({});
    SparseField far;
    setVoxel(far, {1000003, -2000001, 5}, 3);
    far.tiles.push_back({{1000008, -2000000, 8}, 8, 4});
    grids.push_back(buildVolume(far, "b", glm::scale(dmat4(1), dvec3(0.25))));
    const BrickAtlas atlas = packBricks(grids);
    ASSERT_EQ(atlas.volumes.size(), 3u);
    EXPECT_EQ(atlas.volumes[1].brickCount, 0u);
    EXPECT_EQ(atlas.volumes[2].maxValue, 4);
    for (std::size_t v = 0; v < grids.size(); ++v) {
        const AtlasVolume& volume = atlas.volumes[v];
        ASSERT_EQ(volume.brickCount, grids[v].bricks.size());
        ASSERT_EQ(volume.boxCount, grids[v].boxes.size());
        for (std::uint32_t i = 0; i < volume.brickCount; ++i) {
            const Brick& brick = grids[v].bricks[i];
            const AtlasBrick& packed = atlas.bricks[volume.firstBrick + i];
            EXPECT_EQ(packed.origin + volume.anchor, brick.origin);
            EXPECT_EQ(packed.volume, v);
            EXPECT_EQ(packed.maxValue, brick.maxValue);
            EXPECT_LT(glm::length(transformPoint(volume.worldFromIndex, dvec3(packed.origin)) -
                                  transformPoint(grids[v].worldFromIndex, dvec3(brick.origin))),
                      1e-9);
            for (int k = 0; k < kBrickValueCount; ++k)
                ASSERT_EQ(atlas.values[packed.valueOffset + k],
                          grids[v].values[brick.valueOffset + k]);
            const ivec3 coord{brick.origin.x >> 3, brick.origin.y >> 3, brick.origin.z >> 3};
            EXPECT_EQ(findInAtlas(atlas, volume, coord), i);
        }
        if (volume.entryCount > 0) {
            EXPECT_EQ(findInAtlas(atlas, volume, {77, 77, 77}), BrickIndex::kNone);
        }
    }
    EXPECT_LT(std::abs(atlas.boxes[0].lo.x), 100) << "relative to the anchor";
    EXPECT_EQ(atlas.boxes[0].soft, 1u);
    EXPECT_GE(atlas.bytes(), atlas.values.size() * 4);
}

}  // namespace
}  // namespace brume::volumes::test
