// SPDX-License-Identifier: Apache-2.0
// What a surface does to light that meets it: the one place to change for another surface model.
#pragma once

#include <scene/scene.hpp>

namespace brume::reference {

/// L <- added + transmittance * L for radiance L that arrives from behind.
struct SurfaceResponse {
    dvec3 transmittance{0};
    dvec3 added{0};
};

/// Effect of a point of a surface on a ray. `illumination`: ambient radiance + sum over lights of
/// E cos / pi; an opaque surface transmits nothing, the boundary of a solid everything.
SurfaceResponse respond(const scene::Material& material, const dvec2& uv,
                        const dvec3& illumination);

}  // namespace brume::reference
