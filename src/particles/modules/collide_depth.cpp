// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <particles/modules/collide_depth.hpp>
#include <particles/modules/collider_keys.hpp>

namespace brume::particles::collide_depth {
namespace {

void add(const ModuleValues& values, ModuleSums& sums) {
    constexpr const char* kDoing = "setting up the modules of an effect";
    if (sums.depthCollider)
        throw inputError(kDoing, values.where(), "one 'collide_depth' too many, at most 1 allowed");
    if (sums.effect->isWorldSpace)
        throw inputError(kDoing, values.where(),
                         "module 'collide_depth' in an effect with 'space' world, local allowed");
    sums.depthCollider = {.thickness = static_cast<float>(values.number("thickness")),
                          .radius = static_cast<float>(values.number("radius")),
                          .surface = contactSurface(values)};
    sums.depthColliderWhere = values.where();
}

}  // namespace

Module module() {
    return {{.name = "collide_depth",
             .summary = "the opaque meshes as far as the picture shows them",
             .isReplayable = false,
             .keys = withSurfaceKeys({{.name = "thickness",
                                       .unit = "m",
                                       .summary = "of what is seen; particles farther behind pass",
                                       .fallback = {0.5},
                                       .lo = 1e-4,
                                       .hi = 1e6}})},
            add};
}

}  // namespace brume::particles::collide_depth
