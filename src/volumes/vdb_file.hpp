// SPDX-License-Identifier: Apache-2.0
// .vdb and .nvdb files; the only place with OpenVDB (target brume_vdb).
#pragma once

#include <core/log.hpp>
#include <scene/scene.hpp>
#include <volumes/volume_grid.hpp>

#include <filesystem>

namespace brume::volumes {

/// One grid of a file as `brume inspect` prints it.
struct GridInfo {
    std::string name;
    int index = 0;                   ///< among the grids of this name
    std::string type;                ///< "float", "double", "half", "vec3s", ...
    std::string gridClass;           ///< "fog volume", "level set", "staggered", "unknown"
    ivec3 lo{0}, hi{-1};             ///< active index box, inclusive; lo > hi if empty
    std::uint64_t activeVoxels = 0;  ///< tiles counted by their voxels
    std::uint64_t leafCount = 0, activeTileCount = 0;
    double minValue = 0, maxValue = 0;  ///< of the finite active values; lengths of vectors; 0 for
                                        ///< types that are no reals
    double background = 0;
    SanitiseReport sanitised;
    dmat4 worldFromIndex{1};
    std::string transform;  ///< "uniform scale 0.0625", "affine", "frustum"
    std::string refusal;    ///< why it cannot be a density, or empty
};

/// Lists the grids in file order. Throws an input Error if the file is not readable.
std::vector<GridInfo> listGrids(const std::filesystem::path& file);

/// Loads the density that `volume` names, sanitised (docs/formats.md), with worldFromFile applied.
/// Representation Boxes: decomposed with `volume.tolerance` relative to `extinctionMax` (largest
/// channel, 1/m per unit density). Warns once per file and fault through `log`. Throws an input
/// Error (unreadable, no such grid, several of that name, refused type).
VolumeGrid loadVolume(const scene::Volume& volume, double extinctionMax, const Log& log);

/// Loads the grids that an effect's modules and emitters name, and those of its sub-emitters, into
/// their `fields`. At most 2^25 values each. Throws an input Error at the place in the effect's file
/// that names the grid.
void loadEffectFields(scene::Effect& effect);

}  // namespace brume::volumes
