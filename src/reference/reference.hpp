// SPDX-License-Identifier: Apache-2.0
// The exact renderer: CPU, double precision, all threads, no Vulkan. Every method's error is
// measured against it.
#pragma once

#include <core/image.hpp>
#include <scene/medium_sphere.hpp>
#include <scene/scene.hpp>
#include <volumes/volume_grid.hpp>

#include <functional>
#include <span>

namespace brume::reference {

/// All that can be seen. The spans must outlive the call.
struct Input {
    const scene::Scene& scene;
    std::span<const volumes::VolumeGrid> volumes;  ///< parallel to scene.volumes
    std::span<const scene::MediumSphere> spheres;  ///< scene.spheres and all particles, any order
};

struct Options {
    bool shadows = true;  ///< false: every light ignores its `shadow` (what a method without shadow
                          ///< stores shows)
    /// n: of each n x n pixels only the middle one, so that images are smaller by n (rounded up).
    int every = 1;
    std::function<void(double fraction)>
        progress;  ///< called now and then from one thread; may be empty
};

struct Result {
    Image image;  ///< scene.image.width x height, box-filtered over supersamples
    /// Per pixel the wrapping sum over its samples of triangleHash()
    /// (shaders/common/triangle_hash.h) of the opaque triangle seen and of each transparent
    /// triangle crossed in front of it: equal to the rasteriser's where both see the same
    /// triangles.
    std::vector<std::uint32_t> triangles;
};

/// Renders. Throws an input Error for a degenerate camera.
Result render(const Input& input, const Options& options = {});

/// Exact transmittance along a world-space segment (per channel): media, thin and solid surfaces; 0
/// behind opaque ones.
dvec3 transmittance(const Input& input, const dvec3& from, const dvec3& to);

}  // namespace brume::reference
