// SPDX-License-Identifier: Apache-2.0
#include <reference/surface_response.hpp>

#include <scene/texture.hpp>

#include <algorithm>
#include <cmath>

namespace brume::reference {
namespace {

dvec3 emitted(const scene::Material& material, const dvec2& uv) {
    if (!material.emissionTexture) return material.emission;
    return material.emission * dvec3(scene::sampleBilinear(*material.emissionTexture, uv));
}

/// L <- a (Lr + t L) + (1 - a) L (McGuire and Mara 2016, eq. 2).
SurfaceResponse respondThin(const scene::Material& material, const dvec2& uv, const dvec4& texel,
                            const dvec3& illumination, const Gloss& gloss) {
    const double alpha = material.coverage * texel.a;
    const dvec3 color(texel);
    const double rest = 1 - gloss.share;
    const dvec3 radiance =
        rest * material.reflected * color * illumination + emitted(material, uv) + gloss.radiance;
    return {1.0 - alpha + alpha * rest * material.transmission * color, alpha * radiance};
}

}  // namespace

// Fresnel's equations for a dielectric; between the faces of a pane light goes to and fro.
double glassReflectance(double cosine, double ior, bool isPane) {
    const double g = std::sqrt(ior * ior - 1 + cosine * cosine);
    const double a = (g - cosine) / std::max(g + cosine, 1e-12);
    const double b = (cosine * (g + cosine) - 1) / (cosine * (g - cosine) + 1);
    const double one = 0.5 * a * a * (1 + b * b);
    return isPane ? 2 * one / (1 + one) : one;
}

// GGX with Smith's masking: Walter, Marschner, Li, Torrance 2007.
double highlight(const dvec3& n, const dvec3& v, const dvec3& l, const scene::Material& material) {
    const double nl = glm::dot(n, l), nv = std::max(glm::dot(n, v), 1e-4);
    if (nl <= 0) return 0;
    const dvec3 h = glm::normalize(v + l);
    const double a = std::max(material.roughness * material.roughness, 0.002), a2 = a * a;
    const dvec3 across = glm::cross(n, h);
    const double nh = glm::dot(n, h), spread = glm::dot(across, across) + a2 * nh * nh;
    const double d = a2 / (kPi * spread * spread);
    const double masking = 0.5 / (nl * std::sqrt(nv * nv * (1 - a2) + a2) +
                                  nv * std::sqrt(nl * nl * (1 - a2) + a2));
    const bool isPane = material.type == scene::MaterialType::Thin;
    return d * masking * glassReflectance(glm::dot(v, h), material.ior, isPane) * nl;
}

SurfaceResponse respond(const scene::Material& material, const dvec2& uv, const dvec3& illumination,
                        const Gloss& gloss) {
    if (material.type == scene::MaterialType::Solid)
        return {dvec3(1 - gloss.share), gloss.radiance};
    const dvec4 texel(material.colorTexture ? scene::sampleBilinear(*material.colorTexture, uv)
                                            : vec4(1));
    if (material.type == scene::MaterialType::Thin)
        return respondThin(material, uv, texel, illumination, gloss);
    return {dvec3(0), material.albedo * dvec3(texel) * illumination + emitted(material, uv)};
}

}  // namespace brume::reference
