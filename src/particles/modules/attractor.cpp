// SPDX-License-Identifier: Apache-2.0
#include <particles/modules/attractor.hpp>

namespace brume::particles::attractor {
namespace {

void add(const ModuleValues& values, ModuleSums& sums) {
    shader::EffectParameters& parameters = *sums.parameters;
    shader::Attractor& attractor =
        appendModule(values, "attractor", parameters.attractorCount, parameters.attractor);
    const double falloff = values.number("falloff");
    attractor.center = vec3(values.vector("center"));
    attractor.strength =
        static_cast<float>(values.number("strength") * std::pow(values.number("reference"), falloff));
    const dvec3 axis = values.vector("axis");
    attractor.axis = axis == dvec3(0) ? vec3(0) : vec3(glm::normalize(axis));
    attractor.core2 = static_cast<float>(values.number("core") * values.number("core"));
    attractor.power = static_cast<std::uint32_t>(falloff + 1);
    attractor.kill = static_cast<float>(values.number("killRadius"));
}

}  // namespace

Module module() {
    return {{.name = "attractor",
             .summary = "pull towards a point or a line, (distance / reference)^-falloff",
             .keys = {{.name = "center",
                       .unit = "m",
                       .summary = "the point, or one of the line",
                       .fallback = {0, 0, 0},
                       .lo = -1e6,
                       .hi = 1e6},
                      {.name = "axis",
                       .unit = "1",
                       .summary = "direction of the line; zero: a point",
                       .fallback = {0, 0, 0},
                       .lo = -1e6,
                       .hi = 1e6},
                      {.name = "strength",
                       .unit = "m/s^2",
                       .summary = "acceleration at the reference distance; negative pushes away",
                       .fallback = {1},
                       .lo = -1e9,
                       .hi = 1e9},
                      {.name = "reference",
                       .unit = "m",
                       .summary = "distance at which the strength holds",
                       .fallback = {1},
                       .lo = 1e-3,
                       .hi = 1e6},
                      {.name = "falloff",
                       .unit = "1",
                       .summary = "-1 spring, 0 everywhere the same, 1 as 1/r, 2 gravitation",
                       .fallback = {2},
                       .lo = -1,
                       .hi = 2,
                       .isInteger = true},
                      {.name = "core",
                       .unit = "m",
                       .summary = "radius within which the pull is softened",
                       .fallback = {0.05},
                       .lo = 0,
                       .hi = 1e6},
                      {.name = "killRadius",
                       .unit = "m",
                       .summary = "particles that come nearer die; 0: none",
                       .fallback = {0},
                       .lo = 0,
                       .hi = 1e6}}},
            add};
}

}  // namespace brume::particles::attractor
