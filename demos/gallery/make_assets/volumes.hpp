// SPDX-License-Identifier: Apache-2.0
// The volumes of the gallery, sculpted from noise.
#pragma once

#include <filesystem>

namespace brume::gallery {

/// Writes cloud.vdb, campfire.vdb, explosion.vdb, haze.vdb and nebula.vdb into `folder`.
/// `detail`: voxels along an edge relative to what the gallery is made with. Throws on failure.
void writeVolumes(const std::filesystem::path& folder, float detail);

}  // namespace brume::gallery
