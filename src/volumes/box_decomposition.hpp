// SPDX-License-Identifier: Apache-2.0
// Bricks to homogeneous boxes: the cheap stand-in for a volume, with a bound of its error.
#pragma once

#include <volumes/volume_grid.hpp>

namespace brume::volumes {

/// Replaces the bricks of `grid` by hard boxes of their mean density. An octree over the cells is
/// split while (max - min) * extinctionMax * longest world edge > tolerance, where max and min are
/// those of the means of its cells; down to single cells; boxes of zeros are left out. Soft boxes
/// stay: they are exact. Sets opticalDepthBound, which holds for every straight ray and counts what
/// varies inside the cells too.
void convertToBoxes(VolumeGrid& grid, double extinctionMax, double tolerance);

}  // namespace brume::volumes
