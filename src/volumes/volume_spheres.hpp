// SPDX-License-Identifier: Apache-2.0
// A volume as soft spheres, so that the particle path can draw it.
#pragma once

#include <scene/medium_sphere.hpp>
#include <volumes/volume_grid.hpp>

#include <cstdint>
#include <vector>

namespace brume::volumes {

struct SphereOptions {
    std::uint32_t medium = 0;
    std::uint32_t firstId = 0;  ///< ids count up from here
    double radiusFactor = 1.0;  ///< radius / edge of a cube with the volume of one block
    std::size_t maxSpheres = 1u << 24;
};

/// One smooth sphere per block of 2^3 cells with density, at the block's centre of mass. Keeps the
/// mass: the integral of (1 - r^2/R^2)^2 over a ball is 32 pi R^3 / 105. Throws an input Error if
/// it takes more than maxSpheres.
std::vector<scene::MediumSphere> convertToSpheres(const VolumeGrid& grid,
                                                  const SphereOptions& options);

}  // namespace brume::volumes
