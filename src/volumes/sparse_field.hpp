// SPDX-License-Identifier: Apache-2.0
// Voxels and tiles as a file holds them, whatever its format, and their way into a VolumeGrid.
#pragma once

#include <volumes/volume_grid.hpp>

#include <array>
#include <string>
#include <vector>

namespace brume::volumes {

inline constexpr int kBlockEdge = 8;

/// 8^3 voxels, as in a leaf of an OpenVDB tree.
struct VoxelBlock {
    ivec3 origin{0};  ///< a multiple of 8
    std::array<float, kBlockEdge * kBlockEdge * kBlockEdge>
        values;  ///< [(x * 8 + y) * 8 + z]; inactive voxels are 0
};

/// A cube of equal active voxels.
struct ConstantTile {
    ivec3 lo{0};
    int edge = 0;  ///< voxels
    float value = 0;
};

struct SparseField {
    std::vector<VoxelBlock> blocks;   ///< no two with one origin
    std::vector<ConstantTile> tiles;  ///< disjoint from the blocks
    double background = 0;
};

/// What infinite voxels become: the largest finite half float.
inline constexpr float kValueCap = 65504.0f;

/// Greater values count as infinite: times an extinction they would be, in 32 bits.
inline constexpr float kGreatestValue = 1e30f;

/// Repairs all values in place: NaN and negative become 0, infinite kValueCap. Negative zeros are
/// no fault.
SanitiseReport sanitise(SparseField& field);

/// Bytes of brick values that buildVolume() makes at most.
inline constexpr std::uint64_t kMaxBrickBytes = 2ull << 30;

/// Sanitises, then cuts blocks into bricks and turns tiles into soft boxes, neighbouring ones of
/// one value merged. Throws an input Error (naming `name`) if the bricks would take more than
/// kMaxBrickBytes, or if the transform or an index is out of range.
VolumeGrid buildVolume(SparseField field, const std::string& name, const dmat4& worldFromIndex);

}  // namespace brume::volumes
