// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <particles/modules/collide_level_set.hpp>
#include <particles/modules/collider_keys.hpp>

#include <algorithm>

namespace brume::particles::collide_level_set {
namespace {

void add(const ModuleValues& values, ModuleSums& sums) {
    shader::EffectParameters& parameters = *sums.parameters;
    shader::LevelSetCollider& solid = appendModule(
        values, "level set", parameters.levelSetColliderCount, parameters.levelSetCollider);
    const scene::FieldPlacement placement = values.field();
    const scene::FieldValues& field = findField(*sums.effect, placement, 1);
    if (!field.isLevelSet)
        throw inputError("setting up the modules of an effect", placement.where,
                         "the grid is no level set, one whose class says so allowed");
    solid.grid = sums.fields->add(placement, field, field.background);
    const dmat4 place = effectFromIndex(placement, field);
    const double voxel = std::min({glm::length(dvec3(place[0])), glm::length(dvec3(place[1])),
                                   glm::length(dvec3(place[2]))});
    solid.scale = static_cast<float>(placement.scale);
    solid.radius = static_cast<float>(values.number("radius"));
    solid.leastStep = static_cast<float>(0.5 * voxel);
    solid.surface = contactSurface(values);
}

}  // namespace

Module module() {
    return {{.name = "collide_level_set",
             .summary = "a solid that particles hit, given by a VDB level set",
             .keys = withFieldKeys(withSurfaceKeys({}))},
            add};
}

}  // namespace brume::particles::collide_level_set
