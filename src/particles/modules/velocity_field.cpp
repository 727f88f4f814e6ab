// SPDX-License-Identifier: Apache-2.0
#include <particles/modules/velocity_field.hpp>

namespace brume::particles::velocity_field {
namespace {

void add(const ModuleValues& values, ModuleSums& sums) {
    shader::EffectParameters& parameters = *sums.parameters;
    shader::VelocityField& field = appendModule(
        values, "velocity_field", parameters.velocityFieldCount, parameters.velocityField);
    const scene::FieldPlacement placement = values.field();
    field.grid = sums.fields->add(placement, findField(*sums.effect, placement, 3), 0);
    field.strength = static_cast<float>(values.number("strength"));
    field.advects = values.choice("mode") == 0;
    if (field.advects) return;
    // The share in the drag of the effect is known only when all modules are; see addModules().
    field.weight = static_cast<float>(values.number("rate"));
    sums.dragRate += values.number("rate");
}

}  // namespace

Module module() {
    return {{.name = "velocity_field",
             .summary = "air that moves as a VDB grid of velocities says",
             .keys = withFieldKeys(
                 {{.name = "mode",
                   .unit = "word",
                   .summary = "carries particles along, or drags them",
                   .fallback = {},
                   .choices = {"advect", "drag"}},
                  {.name = "strength",
                   .unit = "1",
                   .summary = "factor of the velocities",
                   .fallback = {1},
                   .lo = -1e6,
                   .hi = 1e6},
                  {.name = "rate",
                   .unit = "1/s",
                   .summary = "drag: rate towards the velocity of the air, everywhere",
                   .fallback = {5},
                   .lo = 0,
                   .hi = 1e6}})},
            add};
}

}  // namespace brume::particles::velocity_field
