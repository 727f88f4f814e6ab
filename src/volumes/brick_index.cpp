// SPDX-License-Identifier: Apache-2.0
#include <volumes/brick_index.hpp>

#include <bit>

namespace brume::volumes {
namespace {

/// A page table may be this many times larger than the list of bricks before hashing takes over.
constexpr std::uint64_t kPagesPerBrick = 64;
constexpr std::uint64_t kSmallTable = 1u << 16;

ivec3 coordOf(const Brick& brick) {
    return {brick.origin.x >> 3, brick.origin.y >> 3, brick.origin.z >> 3};
}

}  // namespace

BrickIndex::BrickIndex(const VolumeGrid& grid) {
    if (grid.bricks.empty()) return;
    ivec3 lo = coordOf(grid.bricks.front()), hi = lo;
    for (const Brick& brick : grid.bricks) {
        lo = glm::min(lo, coordOf(brick));
        hi = glm::max(hi, coordOf(brick));
    }
    // In double: the box of far-apart bricks overflows 64 bits.
    const dvec3 size = dvec3(hi) - dvec3(lo) + 1.0;
    const auto allowed = std::max<std::uint64_t>(kSmallTable, kPagesPerBrick * grid.bricks.size());
    if (size.x * size.y * size.z > static_cast<double>(allowed)) {
        mEntries = buildBrickHash(grid);
        return;
    }
    mLow = lo;
    mSize = hi - lo + 1;
    mPages.assign(static_cast<std::size_t>(size.x * size.y * size.z), kNone);
    for (std::uint32_t i = 0; i < grid.bricks.size(); ++i) {
        const ivec3 c = coordOf(grid.bricks[i]) - mLow;
        mPages[(static_cast<std::size_t>(c.z) * mSize.y + c.y) * mSize.x + c.x] = i;
    }
}

std::uint32_t BrickIndex::find(const ivec3& coord) const {
    if (!mPages.empty()) {
        // Unsigned differences: one comparison per axis and no overflow far outside the box.
        const auto x = static_cast<std::uint32_t>(coord.x) - static_cast<std::uint32_t>(mLow.x);
        const auto y = static_cast<std::uint32_t>(coord.y) - static_cast<std::uint32_t>(mLow.y);
        const auto z = static_cast<std::uint32_t>(coord.z) - static_cast<std::uint32_t>(mLow.z);
        if (x >= static_cast<std::uint32_t>(mSize.x) || y >= static_cast<std::uint32_t>(mSize.y) ||
            z >= static_cast<std::uint32_t>(mSize.z))
            return kNone;
        return mPages[(static_cast<std::size_t>(z) * mSize.y + y) * mSize.x + x];
    }
    if (mEntries.empty()) return kNone;
    const std::size_t mask = mEntries.size() - 1;
    for (std::size_t slot = hashBrick(coord) & mask;; slot = (slot + 1) & mask) {
        const Entry& entry = mEntries[slot];
        if (entry.brick == kNone || entry.coord == coord) return entry.brick;
    }
}

std::vector<BrickIndex::Entry> buildBrickHash(const VolumeGrid& grid) {
    std::vector<BrickIndex::Entry> entries(std::bit_ceil(2 * grid.bricks.size() + 1));
    const std::size_t mask = entries.size() - 1;
    for (std::uint32_t i = 0; i < grid.bricks.size(); ++i) {
        const ivec3 coord = coordOf(grid.bricks[i]);
        std::size_t slot = hashBrick(coord) & mask;
        while (entries[slot].brick != BrickIndex::kNone) slot = (slot + 1) & mask;
        entries[slot] = {coord, i};
    }
    return entries;
}

}  // namespace brume::volumes
