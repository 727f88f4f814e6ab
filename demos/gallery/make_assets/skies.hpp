// SPDX-License-Identifier: Apache-2.0
// The backgrounds of the gallery: latitude-longitude maps, the middle of which is -Z.
#pragma once

#include <filesystem>

namespace brume::gallery {

/// Writes sunset.exr, night.exr, morning.exr and studio.exr into `folder`. Throws on failure.
void writeSkies(const std::filesystem::path& folder);

}  // namespace brume::gallery
