// SPDX-License-Identifier: Apache-2.0
#include <particles/modules/collider_keys.hpp>
#include <particles/modules/collide_box.hpp>

namespace brume::particles::collide_box {
namespace {

void add(const ModuleValues& values, ModuleSums& sums) {
    addBox(values, sums, values.number("radius")).surface = contactSurface(values);
}

}  // namespace

Module module() {
    return {{.name = "collide_box",
             .summary = "a box that particles hit, however fast they are",
             .keys = withSurfaceKeys(boxKeys())},
            add};
}

}  // namespace brume::particles::collide_box
