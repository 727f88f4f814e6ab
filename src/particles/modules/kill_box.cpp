// SPDX-License-Identifier: Apache-2.0
#include <particles/modules/collider_keys.hpp>
#include <particles/modules/kill_box.hpp>

namespace brume::particles::kill_box {
namespace {

void add(const ModuleValues& values, ModuleSums& sums) {
    addBox(values, sums, 0).surface = killingSurface();
}

}  // namespace

Module module() {
    return {{.name = "kill_box",
             .summary = "kills what leaves the allowed side of a box",
             .keys = boxKeys()},
            add};
}

}  // namespace brume::particles::kill_box
