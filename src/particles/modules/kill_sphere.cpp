// SPDX-License-Identifier: Apache-2.0
#include <particles/modules/collider_keys.hpp>
#include <particles/modules/kill_sphere.hpp>

namespace brume::particles::kill_sphere {
namespace {

void add(const ModuleValues& values, ModuleSums& sums) {
    addSphere(values, sums, 0).surface = killingSurface();
}

}  // namespace

Module module() {
    return {{.name = "kill_sphere",
             .summary = "kills what leaves the allowed side of a sphere",
             .keys = sphereKeys()},
            add};
}

}  // namespace brume::particles::kill_sphere
