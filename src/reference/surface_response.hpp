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

/// What glass mirrors at a point: the share of light, and the radiance that this sends back.
struct Gloss {
    double share = 0;
    dvec3 radiance{0};
};

/// Share of light that glass reflects at this cosine of incidence; both faces of a pane together.
double glassReflectance(double cosine, double ior, bool isPane);

/// Reflected radiance per irradiance of a light: the microfacet lobe times the cosine. All unit,
/// `n` towards the viewer.
double highlight(const dvec3& n, const dvec3& v, const dvec3& l, const scene::Material& material);

/// Effect of a point of a surface on a ray. `illumination`: ambient radiance + sum over lights of
/// E cos / pi; an opaque surface transmits nothing, the boundary of a solid all that it does not
/// mirror.
SurfaceResponse respond(const scene::Material& material, const dvec2& uv, const dvec3& illumination,
                        const Gloss& gloss = {});

}  // namespace brume::reference
