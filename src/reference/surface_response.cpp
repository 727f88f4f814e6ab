// SPDX-License-Identifier: Apache-2.0
#include <reference/surface_response.hpp>

#include <scene/texture.hpp>

namespace brume::reference {
namespace {

dvec3 emitted(const scene::Material& material, const dvec2& uv) {
    if (!material.emissionTexture) return material.emission;
    return material.emission * dvec3(scene::sampleBilinear(*material.emissionTexture, uv));
}

/// L <- a (Lr + t L) + (1 - a) L (McGuire and Mara 2016, eq. 2).
SurfaceResponse respondThin(const scene::Material& material, const dvec2& uv, const dvec4& texel,
                            const dvec3& illumination) {
    const double alpha = material.coverage * texel.a;
    const dvec3 color(texel);
    const dvec3 radiance = material.reflected * color * illumination + emitted(material, uv);
    return {1.0 - alpha + alpha * material.transmission * color, alpha * radiance};
}

}  // namespace

SurfaceResponse respond(const scene::Material& material, const dvec2& uv,
                        const dvec3& illumination) {
    if (material.type == scene::MaterialType::Solid) return {dvec3(1), dvec3(0)};
    const dvec4 texel(material.colorTexture ? scene::sampleBilinear(*material.colorTexture, uv)
                                            : vec4(1));
    if (material.type == scene::MaterialType::Thin)
        return respondThin(material, uv, texel, illumination);
    return {dvec3(0), material.albedo * dvec3(texel) * illumination + emitted(material, uv)};
}

}  // namespace brume::reference
