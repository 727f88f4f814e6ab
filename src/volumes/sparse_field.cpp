// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <volumes/brick_index.hpp>
#include <volumes/sparse_field.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <tuple>

namespace brume::volumes {
namespace {

/// Indices beyond this lose their neighbours to 32-bit overflow on the way.
constexpr int kMaxIndex = 1 << 30;
constexpr int kNeighbours = 8;  ///< bit 0: one block back in x, bit 1: y, bit 2: z

auto orderOf(const ivec3& c) { return std::tuple(c.z, c.y, c.x); }

ivec3 neighbourStep(int neighbour) {
    return {neighbour & 1 ? 1 : 0, neighbour & 2 ? 1 : 0, neighbour & 4 ? 1 : 0};
}

float repair(float value, std::uint64_t voxels, SanitiseReport& report) {
    if (std::isnan(value)) {
        report.nan += voxels;
        return 0;
    }
    if (value < 0) {
        report.negative += voxels;
        return 0;
    }
    if (value > kGreatestValue) {
        report.infinite += voxels;
        return kValueCap;
    }
    return value + 0.0f;  // -0 becomes 0
}

/// Which bricks a block reaches: bit e is set if some value lies on its low side in all axes of e.
unsigned reachOf(const VoxelBlock& block) {
    unsigned reach = 0;
    for (int x = 0; x < kBlockEdge; ++x)
        for (int y = 0; y < kBlockEdge; ++y)
            for (int z = 0; z < kBlockEdge; ++z) {
                if (block.values[(x * kBlockEdge + y) * kBlockEdge + z] == 0) continue;
                const int low = (x == 0 ? 1 : 0) | (y == 0 ? 2 : 0) | (z == 0 ? 4 : 0);
                for (int e = 0; e < kNeighbours; ++e)
                    if ((e & low) == e) reach |= 1u << e;
            }
    return reach;
}

void checkTransform(const std::string& name, const dmat4& m) {
    bool finite = true;
    for (int i = 0; i < 16; ++i) finite = finite && std::isfinite(m[i / 4][i % 4]);
    const double det = finite ? glm::determinant(dmat3(m)) : 0;
    if (!finite || det == 0 || !std::isfinite(1 / det))
        throw inputError("loading volume", name,
                         "the transform is singular or not finite, an invertible one is needed");
}

void checkIndices(const std::string& name, const ivec3& lo, std::int64_t edge) {
    for (int axis = 0; axis < 3; ++axis)
        if (lo[axis] < -kMaxIndex || lo[axis] + edge > kMaxIndex)
            throw inputError("loading volume", name,
                             fmt::format("a voxel index is near {}, at most {} is allowed",
                                         lo[axis], kMaxIndex));
}

/// Origins of all bricks with a value, in the order of memory (z slowest).
std::vector<ivec3> collectOrigins(const SparseField& field, const std::string& name) {
    std::vector<ivec3> origins;
    for (const VoxelBlock& block : field.blocks) {
        const unsigned reach = reachOf(block);
        if (reach != 0) checkIndices(name, block.origin, kBlockEdge);
        for (int e = 0; e < kNeighbours; ++e)
            if (reach & (1u << e)) origins.push_back(block.origin - kBrickCells * neighbourStep(e));
    }
    std::sort(origins.begin(), origins.end(),
              [](const ivec3& a, const ivec3& b) { return orderOf(a) < orderOf(b); });
    origins.erase(std::unique(origins.begin(), origins.end()), origins.end());
    return origins;
}

/// Copies what a block contributes to a brick that starts `step` blocks before it.
void copyBlock(const VoxelBlock& block, const ivec3& step, float* values) {
    const ivec3 count{step.x ? 1 : kBlockEdge, step.y ? 1 : kBlockEdge, step.z ? 1 : kBlockEdge};
    const ivec3 at = step * kBrickCells;
    for (int z = 0; z < count.z; ++z)
        for (int y = 0; y < count.y; ++y)
            for (int x = 0; x < count.x; ++x)
                values[((at.z + z) * kBrickValues + at.y + y) * kBrickValues + at.x + x] =
                    block.values[(x * kBlockEdge + y) * kBlockEdge + z];
}

/// Index of the blocks, through the same table that finds bricks.
BrickIndex indexBlocks(const SparseField& field) {
    VolumeGrid blocks;
    blocks.bricks.reserve(field.blocks.size());
    for (const VoxelBlock& block : field.blocks) blocks.bricks.push_back({block.origin, 0, 0});
    return BrickIndex(blocks);
}

void buildBricks(const SparseField& field, VolumeGrid& grid) {
    const std::vector<ivec3> origins = collectOrigins(field, grid.name);
    const std::uint64_t bytes = origins.size() * kBrickValueCount * sizeof(float);
    if (bytes > kMaxBrickBytes)
        throw inputError(
            "loading volume", grid.name,
            fmt::format("{} bricks of 8^3 cells need {} MiB, at most {} MiB are allowed",
                        origins.size(), bytes >> 20, kMaxBrickBytes >> 20));
    const BrickIndex blocks = indexBlocks(field);
    grid.bricks.reserve(origins.size());
    grid.values.assign(origins.size() * kBrickValueCount, 0.0f);
    for (const ivec3& origin : origins) {
        const auto offset = static_cast<std::uint32_t>(grid.bricks.size() * kBrickValueCount);
        float* values = grid.values.data() + offset;
        for (int e = 0; e < kNeighbours; ++e) {
            const ivec3 step = neighbourStep(e);
            const std::uint32_t block = blocks.findCell(origin + kBrickCells * step);
            if (block != BrickIndex::kNone) copyBlock(field.blocks[block], step, values);
        }
        const float greatest = *std::max_element(values, values + kBrickValueCount);
        grid.bricks.push_back({origin, greatest, offset});
    }
}

/// Merges boxes that share a face, a value and their extents across it. The soft field is the same:
/// between two neighbours of one value the ramps add up to it.
void mergeAlong(std::vector<ValueBox>& boxes, int axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto profile = [&](const ValueBox& b) {
        return std::tuple(std::bit_cast<std::uint32_t>(b.value), b.lo[u], b.hi[u], b.lo[v],
                          b.hi[v]);
    };
    std::sort(boxes.begin(), boxes.end(), [&](const ValueBox& a, const ValueBox& b) {
        return std::tuple(profile(a), a.lo[axis]) < std::tuple(profile(b), b.lo[axis]);
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const bool joins = kept > 0 && profile(boxes[kept - 1]) == profile(boxes[i]) &&
                           boxes[kept - 1].hi[axis] + 1 == boxes[i].lo[axis];
        if (joins)
            boxes[kept - 1].hi[axis] = boxes[i].hi[axis];
        else
            boxes[kept++] = boxes[i];
    }
    boxes.resize(kept);
}

void buildBoxes(const SparseField& field, VolumeGrid& grid) {
    for (const ConstantTile& tile : field.tiles) {
        if (tile.value == 0) continue;
        checkIndices(grid.name, tile.lo, tile.edge);
        const dvec3 lo(tile.lo);
        grid.boxes.push_back({lo, lo + static_cast<double>(tile.edge - 1), tile.value, true});
    }
    for (int axis = 0; axis < 3; ++axis) mergeAlong(grid.boxes, axis);
}

}  // namespace

SanitiseReport sanitise(SparseField& field) {
    SanitiseReport report;
    report.cap = kValueCap;
    report.clippedBackground = field.background != 0;  // also if it is not a number
    for (VoxelBlock& block : field.blocks)
        for (float& value : block.values) value = repair(value, 1, report);
    for (ConstantTile& tile : field.tiles) {
        const auto edge = static_cast<std::uint64_t>(tile.edge);
        tile.value = repair(tile.value, edge * edge * edge, report);
    }
    return report;
}

VolumeGrid buildVolume(SparseField field, const std::string& name, const dmat4& worldFromIndex) {
    checkTransform(name, worldFromIndex);
    VolumeGrid grid;
    grid.name = name;
    grid.worldFromIndex = worldFromIndex;
    grid.report = sanitise(field);
    buildBricks(field, grid);
    buildBoxes(field, grid);
    return grid;
}

}  // namespace brume::volumes
