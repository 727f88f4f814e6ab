// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <particles/modules/collide_capsule.hpp>
#include <particles/modules/collider_keys.hpp>

namespace brume::particles::collide_capsule {
namespace {

void add(const ModuleValues& values, ModuleSums& sums) {
    shader::EffectParameters& parameters = *sums.parameters;
    shader::CapsuleCollider& capsule = appendModule(
        values, "capsule", parameters.capsuleColliderCount, parameters.capsuleCollider);
    const dvec3 way = values.vector("to") - values.vector("from");
    const double length = glm::length(way);
    if (!(length > 1e-6))
        throw inputError("setting up the modules of an effect", values.where(),
                         "'from' and 'to' of module 'collide_capsule' are the same place, "
                         "different ones allowed");
    capsule.start = vec3(values.vector("from"));
    capsule.extent = static_cast<float>(length);
    capsule.axis = vec3(way / length);
    capsule.radius = static_cast<float>(values.number("size") + values.number("radius"));
    capsule.surface = contactSurface(values);
}

}  // namespace

Module module() {
    return {{.name = "collide_capsule",
             .summary = "a rod with round ends that particles hit, however fast they are",
             .keys = withSurfaceKeys({{.name = "from",
             .unit = "m",
             .summary = "one end of the rod",
             .fallback = {0, 0, 0},
             .lo = -1e6,
             .hi = 1e6},
            {.name = "to",
             .unit = "m",
             .summary = "its other end",
             .fallback = {0, 1, 0},
             .lo = -1e6,
             .hi = 1e6},
            {.name = "size",
             .unit = "m",
             .summary = "radius of the rod",
             .fallback = {0.1},
             .lo = 1e-4,
             .hi = 1e6}})},
            add};
}

}  // namespace brume::particles::collide_capsule
