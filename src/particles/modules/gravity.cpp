// SPDX-License-Identifier: Apache-2.0
#include <particles/modules/gravity.hpp>

namespace brume::particles::gravity {
namespace {

void add(const ModuleValues& values, ModuleSums& sums) {
    sums.acceleration += values.vector("acceleration");
}

}  // namespace

Module module() {
    return {{.name = "gravity",
             .summary = "constant acceleration",
             .keys = {{.name = "acceleration",
                       .unit = "m/s^2",
                       .summary = "in effect space",
                       .fallback = {0, -9.81, 0},
                       .lo = -1e12,
                       .hi = 1e12}}},
            add};
}

}  // namespace brume::particles::gravity
