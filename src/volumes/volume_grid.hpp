// SPDX-License-Identifier: Apache-2.0
// A sanitised scalar field, ready for the GPU and for the reference: the data part of volumes.
#pragma once

#include <core/math.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace brume::volumes {

inline constexpr int kBrickCells = 8;  ///< cells per brick edge
inline constexpr int kBrickValues =
    kBrickCells + 1;  ///< values per brick edge: the corners of the cells
inline constexpr int kBrickValueCount = kBrickValues * kBrickValues * kBrickValues;

/// 8^3 cells of trilinear density; value (i, j, k) of a brick sits at index `origin` + (i, j, k)
/// and is stored at VolumeGrid::values[valueOffset + (k * 9 + j) * 9 + i].
struct Brick {
    ivec3 origin{0};     ///< multiple of 8
    float maxValue = 0;  ///< of its 9^3 values
    std::uint32_t valueOffset = 0;
};

/// A box of constant value. Soft (active tiles): the voxels lo..hi (inclusive) hold `value`, and
/// the density is their trilinear interpolation towards 0: value * product over axes of ramp, where
/// ramp rises from 0 at lo-1 to 1 at lo and falls from 1 at hi to 0 at hi+1. Hard (box
/// decomposition): `value` in lo <= x <= hi, 0 outside.
struct ValueBox {
    dvec3 lo{0}, hi{0};  ///< index space
    float value = 0;
    bool soft = false;
};

/// What was repaired while loading.
struct SanitiseReport {
    std::uint64_t nan = 0;       ///< NaN voxels set to 0
    std::uint64_t negative = 0;  ///< negative voxels set to 0
    std::uint64_t infinite = 0;  ///< infinite voxels (half overflow, above 1e30) set to the cap
    float cap = 0;               ///< what infinite voxels were set to
    bool clippedBackground =
        false;  ///< the background is not 0; outside the active voxels it is taken as 0
};

/// One field. Density at a world point = sum over bricks and boxes of their trilinear value at
/// index position inverse(worldFromIndex) * point; outside all of them 0. A voxel's value sits at
/// its integer index; inactive voxels count as 0. Bricks are disjoint; boxes may overlap them and
/// add up.
struct VolumeGrid {
    std::string name;
    dmat4 worldFromIndex{1};  ///< affine, invertible; mirror and shear allowed
    std::vector<Brick> bricks;
    std::vector<float> values;
    std::vector<ValueBox> boxes;
    SanitiseReport report;
    double opticalDepthBound =
        0;  ///< boxes made with a tolerance: bound of |delta tau| per unit extinction, else 0

    bool isEmpty() const { return bricks.empty() && boxes.empty(); }
    Box3 indexBounds() const;  ///< of what is not 0; empty if isEmpty()
    Box3 worldBounds() const;  ///< box around indexBounds() in the world; empty if isEmpty()
};

}  // namespace brume::volumes
