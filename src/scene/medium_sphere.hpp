// SPDX-License-Identifier: Apache-2.0
// The soft sphere that particles, scene spheres and converted volumes all become before rendering.
#pragma once

#include <scene/scene.hpp>

namespace brume::scene {

/// Density constant or smooth inside `radius`. Medium properties times density; tint multiplies
/// albedo and emission, not extinction.
struct MediumSphere {
    dvec3 center{0};  ///< world
    float radius = 0;
    float density = 0;
    vec3 tint{1};
    std::uint32_t medium = 0;  ///< index into Scene::media
    std::uint32_t id = 0;  ///< unique in the frame and stable when the order changes: breaks ties
                           ///< between equal distances
    Profile profile = Profile::Constant;
    Shadowing shadowing = Shadowing::Sample;
};

/// The spheres of a scene file, with ids from 0 in their order.
std::vector<MediumSphere> makeMediumSpheres(const std::vector<Sphere>& spheres);

}  // namespace brume::scene
