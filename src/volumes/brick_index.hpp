// SPDX-License-Identifier: Apache-2.0
// From brick coordinates to brick numbers: a page table where the box is small, a hash table
// otherwise.
#pragma once

#include <volumes/volume_grid.hpp>

#include <cstdint>
#include <vector>

namespace brume::volumes {

/// Finds the brick of a cell. A brick's coordinate is its origin / 8; cell (i, j, k) spans
/// index positions [i, i + 1) x [j, j + 1) x [k, k + 1).
class BrickIndex {
  public:
    static constexpr std::uint32_t kNone = 0xffffffffu;

    /// One slot of the hash table; `brick` is kNone where it is free.
    struct Entry {
        ivec3 coord{0};
        std::uint32_t brick = kNone;
    };

    BrickIndex() = default;
    explicit BrickIndex(const VolumeGrid& grid);

    /// Number of the brick at `coord` (its origin / 8), or kNone.
    std::uint32_t find(const ivec3& coord) const;

    /// Number of the brick that holds `cell`, or kNone.
    std::uint32_t findCell(const ivec3& cell) const {
        return find({cell.x >> 3, cell.y >> 3, cell.z >> 3});
    }

  private:
    ivec3 mLow{0};                      ///< coordinate of the first page
    ivec3 mSize{0};                     ///< pages per axis; 0 if hashed
    std::vector<std::uint32_t> mPages;  ///< x fastest
    std::vector<Entry> mEntries;        ///< a power of two of them
};

/// Slot of the hash table to look at first, before masking with its size less one; on a miss the
/// next one follows. The same function exists for shaders, so it is plain 32-bit arithmetic.
inline std::uint32_t hashBrick(const ivec3& coord) {
    const auto x = static_cast<std::uint32_t>(coord.x), y = static_cast<std::uint32_t>(coord.y),
               z = static_cast<std::uint32_t>(coord.z);
    std::uint32_t h = x * 73856093u ^ y * 19349663u ^ z * 83492791u;
    h ^= h >> 16;
    h *= 0x7feb352du;
    return h ^ (h >> 15);
}

/// The hash table of a grid's bricks with at most half of the slots in use: at least one slot.
std::vector<BrickIndex::Entry> buildBrickHash(const VolumeGrid& grid);

}  // namespace brume::volumes
