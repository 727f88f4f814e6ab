// SPDX-License-Identifier: Apache-2.0
#include <particles/modules/vortex.hpp>

namespace brume::particles::vortex {
namespace {

void add(const ModuleValues& values, ModuleSums& sums) {
    shader::EffectParameters& parameters = *sums.parameters;
    shader::Vortex& vortex =
        appendModule(values, "vortex", parameters.vortexCount, parameters.vortex);
    vortex.center = vec3(values.vector("center"));
    // The share in the drag of the effect is known only when all modules are; see addModules().
    vortex.weight = static_cast<float>(values.number("rate"));
    vortex.axis = vec3(values.vector("axis"));
    vortex.strength = static_cast<float>(values.number("circulation") / (2 * kPi));
    vortex.core2 = static_cast<float>(values.number("core") * values.number("core"));
    vortex.inflow = static_cast<float>(values.number("inflow"));
    vortex.updraft = static_cast<float>(values.number("updraft"));
    vortex.halfLength = static_cast<float>(0.5 * values.number("length"));
    sums.dragRate += values.number("rate");
}

}  // namespace

Module module() {
    return {{.name = "vortex",
             .summary = "air that circles around a line and drags particles along",
             .keys = {{.name = "center",
                       .unit = "m",
                       .summary = "a point of the axis",
                       .fallback = {0, 0, 0},
                       .lo = -1e6,
                       .hi = 1e6},
                      {.name = "axis",
                       .unit = "1",
                       .summary = "direction of the axis; the air turns counter-clockwise around it",
                       .fallback = {0, 1, 0},
                       .lo = -1e9,
                       .hi = 1e9,
                       .isDirection = true},
                      {.name = "circulation",
                       .unit = "m^2/s",
                       .summary = "of a wide circle; 2 pi times radius times speed",
                       .fallback = {1},
                       .lo = -1e6,
                       .hi = 1e6},
                      {.name = "core",
                       .unit = "m",
                       .summary = "radius of the fastest air",
                       .fallback = {0.1},
                       .lo = 1e-4,
                       .hi = 1e6},
                      {.name = "inflow",
                       .unit = "1",
                       .summary = "speed towards the axis per speed around it",
                       .fallback = {0},
                       .lo = -100,
                       .hi = 100},
                      {.name = "updraft",
                       .unit = "1",
                       .summary = "speed along the axis per speed around it",
                       .fallback = {0},
                       .lo = -100,
                       .hi = 100},
                      {.name = "length",
                       .unit = "m",
                       .summary = "of the vortex along its axis, half of it to either side of the centre",
                       .fallback = {1e9},
                       .lo = 0,
                       .hi = 1e9},
                      {.name = "rate",
                       .unit = "1/s",
                       .summary = "drag rate towards the velocity of the air",
                       .fallback = {5},
                       .lo = 0,
                       .hi = 1e6}}},
            add};
}

}  // namespace brume::particles::vortex
