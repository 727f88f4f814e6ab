// SPDX-License-Identifier: Apache-2.0
#include <particles/modules/collider_keys.hpp>
#include <particles/modules/collide_sphere.hpp>

namespace brume::particles::collide_sphere {
namespace {

void add(const ModuleValues& values, ModuleSums& sums) {
    addSphere(values, sums, values.number("radius")).surface = contactSurface(values);
}

}  // namespace

Module module() {
    return {{.name = "collide_sphere",
             .summary = "a sphere that particles hit, however fast they are",
             .keys = withSurfaceKeys(sphereKeys())},
            add};
}

}  // namespace brume::particles::collide_sphere
