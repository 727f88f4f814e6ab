// SPDX-License-Identifier: Apache-2.0
// The bricks and boxes of all volumes of a frame as flat arrays, laid out for upload (std430). No
// Vulkan.
#pragma once

#include <volumes/brick_index.hpp>
#include <volumes/volume_grid.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace brume::volumes {

/// A brick for shaders, 32 bytes.
struct AtlasBrick {
    ivec3 origin{0};
    float maxValue = 0;
    std::uint32_t valueOffset = 0;  ///< into BrickAtlas::values, a multiple of 729
    std::uint32_t volume = 0;       ///< index into BrickAtlas::volumes
    std::uint32_t padding[2] = {0, 0};
};
static_assert(sizeof(AtlasBrick) == 32);

/// A box for shaders, 48 bytes; lo and hi as in ValueBox.
struct AtlasBox {
    vec3 lo{0};
    float value = 0;
    vec3 hi{0};
    std::uint32_t soft = 0;
    std::uint32_t volume = 0;
    std::uint32_t padding[3] = {0, 0, 0};
};
static_assert(sizeof(AtlasBox) == 48);

/// Where one volume's parts lie. Positions handed to shaders should be relative to `anchor`, an
/// index position inside the volume, so that far origins and tiny voxels keep their precision.
struct AtlasVolume {
    std::uint32_t firstBrick = 0, brickCount = 0;
    std::uint32_t firstBox = 0, boxCount = 0;
    std::uint32_t firstEntry = 0, entryCount = 0;  ///< hash table, entryCount a power of two (or 0)
    float maxValue = 0;
    ivec3 anchor{0};          ///< subtracted from brick origins and boxes
    dmat4 worldFromIndex{1};  ///< of index positions relative to the anchor
};

struct BrickAtlas {
    std::vector<float> values;       ///< 729 per brick, x fastest
    std::vector<AtlasBrick> bricks;  ///< grouped by volume
    std::vector<AtlasBox> boxes;     ///< grouped by volume
    std::vector<BrickIndex::Entry>
        entries;  ///< per volume a hash table of (origin + anchor) / 8, see hashBrick(); brick
                  ///< numbers count from firstBrick
    std::vector<AtlasVolume> volumes;  ///< parallel to the input

    std::size_t bytes() const;
};

/// Packs all volumes. Throws a failure if the values exceed what 32-bit offsets reach.
BrickAtlas packBricks(std::span<const VolumeGrid> volumes);

}  // namespace brume::volumes
