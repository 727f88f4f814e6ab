// SPDX-License-Identifier: Apache-2.0
#include <particles/modules/drag.hpp>

namespace brume::particles::drag {
namespace {

void add(const ModuleValues& values, ModuleSums& sums) {
    const double rate = values.number("rate");
    sums.dragRate += rate;
    sums.dragRateTimesWind += rate * values.vector("wind");
}

}  // namespace

Module module() {
    return {{.name = "drag",
             .summary = "linear drag towards the wind, dv/dt = -rate (v - wind)",
             .keys = {{.name = "rate",
                       .unit = "1/s",
                       .summary = "part of the slip lost per second, at first",
                       .fallback = {1},
                       .lo = 0,
                       .hi = 1e6},
                      {.name = "wind",
                       .unit = "m/s",
                       .summary = "velocity of the air, effect space",
                       .fallback = {0, 0, 0},
                       .lo = -1e6,
                       .hi = 1e6}}},
            add};
}

}  // namespace brume::particles::drag
