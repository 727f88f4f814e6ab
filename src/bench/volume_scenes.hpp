// SPDX-License-Identifier: Apache-2.0
// Fields of voxels made in code.
#pragma once

#include <bench/scenes.hpp>

#include <functional>
#include <optional>
#include <string>

namespace brume::bench {

/// Bricks of the cube [-8 n, 8 n]^3 of voxels, those without density left out.
volumes::VolumeGrid makeBrickGrid(const dmat4& worldFromIndex, int n,
                                  const std::function<float(const ivec3& voxel)>& density);

/// A cloud of voxels; as boxes of that tolerance in thousandths for "boxes_<thousandths>", as bricks
/// for "boxes_0"; nothing for other names.
std::optional<NamedScene> makeBoxesScene(const std::string& name);

/// "shadowed_cloud": the cloud twice as fine, in a sun with shadow store `visibility`.
NamedScene makeShadowedCloud();

}  // namespace brume::bench
