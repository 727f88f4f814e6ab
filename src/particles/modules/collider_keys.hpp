// SPDX-License-Identifier: Apache-2.0
// What the modules with surfaces have in common: keys and their way into the shared structs.
#pragma once

#include <particles/modules/module.hpp>

namespace brume::particles {

/// The keys of a shape followed by those of its surface: response, restitution, friction, radius.
std::vector<ModuleKey> withSurfaceKeys(std::vector<ModuleKey> keys);

/// From those keys.
shader::ContactSurface contactSurface(const ModuleValues& values);

/// That of a volume that kills.
shader::ContactSurface killingSurface();

/// Shapes shared by colliders and killers; `radius`: of the particles, m.
shader::PlaneCollider& addPlane(const ModuleValues& values, ModuleSums& sums, double radius);
shader::SphereCollider& addSphere(const ModuleValues& values, ModuleSums& sums, double radius);
shader::BoxCollider& addBox(const ModuleValues& values, ModuleSums& sums, double radius);

std::vector<ModuleKey> planeKeys();
std::vector<ModuleKey> sphereKeys();
std::vector<ModuleKey> boxKeys();

}  // namespace brume::particles
