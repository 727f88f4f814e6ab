// SPDX-License-Identifier: Apache-2.0
#include <particles/modules/buoyancy.hpp>

namespace brume::particles::buoyancy {
namespace {

void add(const ModuleValues& values, ModuleSums& sums) {
    shader::EffectParameters& parameters = *sums.parameters;
    shader::Buoyancy& buoyancy =
        appendModule(values, "buoyancy", parameters.buoyancyCount, parameters.buoyancy);
    const scene::FieldPlacement placement = values.field();
    const double ambient = values.number("ambient");
    buoyancy.grid = sums.fields->add(placement, findField(*sums.effect, placement, 1), ambient);
    buoyancy.lift = vec3(values.vector("lift"));
    buoyancy.ambient = static_cast<float>(ambient);
}

}  // namespace

Module module() {
    return {{.name = "buoyancy",
             .summary = "lift where a VDB grid of temperatures is warm",
             .keys = withFieldKeys(
                 {{.name = "lift",
                   .unit = "m/s^2",
                   .summary = "acceleration per unit of temperature above the ambient one",
                   .fallback = {0, 1, 0},
                   .lo = -1e6,
                   .hi = 1e6},
                  {.name = "ambient",
                   .unit = "1",
                   .summary = "temperature without lift, in the grid's unit; that outside the grid",
                   .fallback = {0},
                   .lo = -1e6,
                   .hi = 1e6}})},
            add};
}

}  // namespace brume::particles::buoyancy
