// SPDX-License-Identifier: Apache-2.0
// From a parsed scene to everything that renderers want: volumes loaded, spheres listed.
#pragma once

#include <core/log.hpp>
#include <filesystem>
#include <render/renderer.hpp>
#include <scene/scene.hpp>
#include <span>
#include <vector>

namespace brume::bench {

/// Loads the scene's volumes and lists its spheres (volumes shown as particles become spheres and
/// leave an empty grid). Loads the grids of its effects; effects with a surface get a material of
/// their own. Ids of spheres count from 0 in the order of the scene. Of volumes that are sequences
/// (makeFramePath()), the file of `frame` plus the volume's offset. Throws an Error.
render::PreparedScene prepareScene(scene::Scene scene, const Log& log, int frame = 0);

/// Whether another frame of the scene needs other files.
bool hasVolumeSequence(const scene::Scene& scene);

/// The particles of all effects at their times, simulated on the CPU in the scene's order. The scene
/// is a prepared one. Throws an input Error for an effect that asks for an unknown module.
render::EffectContents simulateOnCpu(const scene::Scene& scene);

}  // namespace brume::bench
