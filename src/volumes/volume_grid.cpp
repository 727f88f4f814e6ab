// SPDX-License-Identifier: Apache-2.0
#include <volumes/volume_grid.hpp>

namespace brume::volumes {
namespace {

bool contains(const Box3& outer, const Box3& inner) {
    return glm::all(glm::lessThanEqual(outer.lo, inner.lo)) &&
           glm::all(glm::greaterThanEqual(outer.hi, inner.hi));
}

/// Adds what the non-zero values of a brick reach inside it.
void extendByBrick(Box3& bounds, const VolumeGrid& grid, const Brick& brick) {
    const dvec3 origin(brick.origin);
    const Box3 whole{origin, origin + static_cast<double>(kBrickCells)};
    if (contains(bounds, whole)) return;
    const float* value = grid.values.data() + brick.valueOffset;
    for (int k = 0; k < kBrickValues; ++k)
        for (int j = 0; j < kBrickValues; ++j)
            for (int i = 0; i < kBrickValues; ++i) {
                if (*value++ == 0) continue;
                const dvec3 p = origin + dvec3(i, j, k);
                bounds.extend(Box3{glm::max(p - 1.0, whole.lo), glm::min(p + 1.0, whole.hi)});
            }
}

}  // namespace

Box3 VolumeGrid::indexBounds() const {
    Box3 bounds;
    for (const ValueBox& box : boxes) {
        const double margin = box.soft ? 1 : 0;
        bounds.extend(Box3{box.lo - margin, box.hi + margin});
    }
    for (const Brick& brick : bricks) extendByBrick(bounds, *this, brick);
    return bounds;
}

Box3 VolumeGrid::worldBounds() const { return transformBox(worldFromIndex, indexBounds()); }

}  // namespace brume::volumes
