// SPDX-License-Identifier: Apache-2.0
// Fits the geometry of a shadow map to a light and what it may see.
#pragma once

#include <core/math.hpp>
#include <scene/scene.hpp>

#include <shaders/shadows/common/maps.h>

namespace brume::shadows {

/// A spot wider than this (angle from its axis) gets the six faces of a point light.
inline constexpr double kWidestSingleFace = radians(60);

std::uint32_t faceCountFor(const scene::Light& light);

/// The part of the world that matters; casters elsewhere only count where they shadow it.
struct Focus {
    dvec3 center{0};
    double radius = 0;  ///< m; 0: everything
};

/// Origin, axes, extent and range of `map`, whose resolution is set. `bounds`: of the casters, in
/// the world, not empty; `origin`: of device coordinates; `border`: texels that filters read beyond
/// a face. Directional maps depend on the bounds and the light only, never on the camera: they are
/// quantised in size and snapped to whole texels, so that a static shadow keeps its texels.
void fitMap(const scene::Light& light, const Box3& bounds, const Focus& focus, const dvec3& origin,
            std::uint32_t border, shader::ShadowMap& map);

}  // namespace brume::shadows
