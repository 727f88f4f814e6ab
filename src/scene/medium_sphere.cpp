// SPDX-License-Identifier: Apache-2.0
#include <scene/medium_sphere.hpp>

namespace brume::scene {

std::vector<MediumSphere> makeMediumSpheres(const std::vector<Sphere>& spheres) {
    std::vector<MediumSphere> made;
    for (const Sphere& sphere : spheres)
        made.push_back({.center = sphere.center,
                        .radius = static_cast<float>(sphere.radius),
                        .density = static_cast<float>(sphere.density),
                        .medium = sphere.medium,
                        .id = static_cast<std::uint32_t>(made.size()),
                        .profile = sphere.profile,
                        .shadowing = sphere.shadowing});
    return made;
}

}  // namespace brume::scene
