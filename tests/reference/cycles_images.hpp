// SPDX-License-Identifier: Apache-2.0
// Images of real smoke by Blender's Cycles, an independent renderer, and how far ours are from them.
#pragma once

#include <core/image.hpp>
#include <scene/scene.hpp>
#include <volumes/volume_grid.hpp>

#include <filesystem>
#include <functional>
#include <vector>

namespace brume::test {

/// A volume and where Cycles' camera looked: orthographic along -z, +y up.
struct CyclesView {
    const char* volume;
    double centerX, centerY;
    double scale;  ///< of the larger image dimension, in world units
};
inline constexpr CyclesView kSmoke1{"vdb/openvdb_smoke1.vdb", -7.381, 40.476, 120};
inline constexpr CyclesView kFire16{"blender/fire16/fluid_data_0030.vdb", 0.96875, 0.96875, 2.5};

/// One image of Cycles (box filter) and how finely we render the same.
struct CyclesImage {
    const char* image;
    const CyclesView& view;
    int supersample;
};

/// The images of Cycles are there; without them a test skips.
bool haveCyclesImages();
/// Where the images are expected.
std::filesystem::path cyclesImages();

/// Over pixels and channels.
struct CyclesDifference {
    double rmse = 0;
    double blockRmse = 0;  ///< of the means of 4 x 4 pixels
};

/// Differences from what `render` makes of the volume in that medium, with these lights. Looks at one
/// band of four rows in `bands` of them, all over the image: a third of some ten thousand values tells
/// their root mean square to two percent.
CyclesDifference compareWithCycles(
    const CyclesImage& cycles, const scene::Medium& medium, const dvec3& background,
    const std::vector<scene::Light>& lights, int bands,
    const std::function<Image(const scene::Scene&, const std::vector<volumes::VolumeGrid>&)>& render);

}  // namespace brume::test
