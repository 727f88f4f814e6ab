// SPDX-License-Identifier: Apache-2.0
#include <particles/modules/collider_keys.hpp>
#include <particles/modules/kill_plane.hpp>

namespace brume::particles::kill_plane {
namespace {

void add(const ModuleValues& values, ModuleSums& sums) {
    addPlane(values, sums, 0).surface = killingSurface();
}

}  // namespace

Module module() {
    return {{.name = "kill_plane",
             .summary = "kills what leaves the allowed side of a plane",
             .keys = planeKeys()},
            add};
}

}  // namespace brume::particles::kill_plane
