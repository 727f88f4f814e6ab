// SPDX-License-Identifier: Apache-2.0
// Exact transmittance along any ray, and the insides of solid meshes along it.
#pragma once

#include <reference/media.hpp>
#include <reference/triangles.hpp>

#include <span>
#include <vector>

namespace brume::reference {

/// The end of a ray that nothing stops; finite, so that 0 * end is 0.
inline constexpr double kEndOfRay = 1e30;

/// All that can take light away. The sets must outlive it.
class Occlusion {
  public:
    Occlusion(const TriangleSet& triangles, const MediaSet& media)
        : mTriangles(triangles), mMedia(media) {}

    /// Per channel along [0, tMax] of a ray; surfaces count from tMin on, `except` never.
    dvec3 transmittance(const scene::Ray& ray, double tMin, double tMax,
                        std::uint32_t except = kNoTriangle) const;

    /// Appends the pieces of [0, tMax] inside solid meshes. `hits`: all transparent triangles along
    /// the whole ray, sorted.
    void collectSolids(std::span<const Hit> hits, double tMax, std::vector<Piece>& pieces) const;

    /// Appends the distances along a ray at which the shadows of spheres and triangles begin or
    /// end, unless there are too many of them.
    void collectShadowEdges(const scene::Ray& ray, const scene::Light& light,
                            std::vector<double>& distances) const;

  private:
    void collectSolid(std::span<const Hit> hits, std::uint32_t mesh, double tMax,
                      std::vector<Piece>& pieces) const;

    const TriangleSet& mTriangles;
    const MediaSet& mMedia;
};

}  // namespace brume::reference
