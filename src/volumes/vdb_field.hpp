// SPDX-License-Identifier: Apache-2.0
// OpenVDB grids as dense values for the particle simulator.
#pragma once

#include <openvdb/openvdb.h>
#include <core/math.hpp>
#include <scene/effect.hpp>

#include <cstdint>
#include <string>

namespace brume::volumes {

/// OpenVDB multiplies row vectors from the left, GLM column vectors from the right: the same 16
/// numbers in memory.
inline dmat4 toWorldFromIndex(const openvdb::math::Transform& transform) {
    const openvdb::Mat4d m = transform.baseMap()->getAffineMap()->getMat4();
    dmat4 result;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) result[i][j] = m(i, j);
    return result;
}

/// The active box of a grid of floats, doubles or vectors; what is inactive there is 0, in a level
/// set its own value. Values that are not finite or above 1e18 become 0. Throws MalformedFile.
scene::FieldValues copyField(const openvdb::GridBase& grid, const std::string& name,
                             std::uint64_t maxValues);

}  // namespace brume::volumes
