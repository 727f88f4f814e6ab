// SPDX-License-Identifier: Apache-2.0
#include <particles/modules/collider_keys.hpp>
#include <particles/modules/collide_plane.hpp>

namespace brume::particles::collide_plane {
namespace {

void add(const ModuleValues& values, ModuleSums& sums) {
    addPlane(values, sums, values.number("radius")).surface = contactSurface(values);
}

}  // namespace

Module module() {
    return {{.name = "collide_plane",
             .summary = "a plane that particles hit, however fast they are",
             .keys = withSurfaceKeys(planeKeys())},
            add};
}

}  // namespace brume::particles::collide_plane
