// SPDX-License-Identifier: Apache-2.0
#include <particles/modules/quadratic_drag.hpp>

namespace brume::particles::quadratic_drag {
namespace {

void add(const ModuleValues& values, ModuleSums& sums) {
    shader::EffectParameters& parameters = *sums.parameters;
    shader::QuadraticDrag& drag = appendModule(values, "quadratic_drag",
                                               parameters.quadraticDragCount,
                                               parameters.quadraticDrag);
    drag.wind = vec3(values.vector("wind"));
    drag.coefficient = static_cast<float>(values.number("coefficient"));
}

}  // namespace

Module module() {
    return {{.name = "quadratic_drag",
             .summary = "drag by the square of the speed, dv/dt = -coefficient |v - wind| (v - wind)",
             .keys = {{.name = "coefficient",
                       .unit = "1/m",
                       .summary = "half the air density times drag area per mass",
                       .fallback = {0.1},
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

}  // namespace brume::particles::quadratic_drag
