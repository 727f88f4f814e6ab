// SPDX-License-Identifier: Apache-2.0
// The meshes of the gallery.
#pragma once

#include <filesystem>

namespace brume::gallery {

/// Writes pawn, rook, bishop, queen, king, board, window, figure, street, lamp, rock_1 to rock_3,
/// cliff, conifer, plant, curtain and vase as .glb into `folder`. Throws on failure.
void writeMeshes(const std::filesystem::path& folder);

}  // namespace brume::gallery
