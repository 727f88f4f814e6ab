// SPDX-License-Identifier: Apache-2.0
#include <core/math.hpp>
#include <render/shader_data.hpp>

#include <algorithm>
#include <cmath>

namespace brume::render {

shader::LightData makeLight(const scene::Light& light, const dvec3& origin) {
    shader::LightData data{};
    data.color = vec3(light.color);
    data.type = light.type == scene::LightType::Directional ? shader::kLightDirectional
                : light.type == scene::LightType::Point     ? shader::kLightPoint
                                                            : shader::kLightSpot;
    data.position = vec3(light.position - origin);
    data.positionLo = roundingOf(light.position - origin);
    data.radius = static_cast<float>(light.radius);
    data.direction = vec3(light.direction);
    data.cosInner = static_cast<float>(std::cos(light.innerAngle));
    data.cosOuter = static_cast<float>(std::cos(light.outerAngle));
    return data;
}

shader::MediumData makeMedium(const scene::Medium& medium) {
    return {.extinction = vec3(medium.extinction),
            .phase = medium.phase == scene::PhaseType::Isotropic  ? shader::kPhaseIsotropic
                     : medium.phase == scene::PhaseType::Rayleigh ? shader::kPhaseRayleigh
                                                                  : shader::kPhaseHenyeyGreenstein,
            .albedo = vec3(medium.albedo),
            .g = static_cast<float>(medium.g),
            .emission = vec3(medium.emission)};
}

shader::MaterialData makeMaterial(const scene::Material& material) {
    shader::MaterialData data{};
    data.albedo = vec3(material.albedo);
    data.type = material.type == scene::MaterialType::Opaque ? shader::kMaterialOpaque
                : material.type == scene::MaterialType::Thin ? shader::kMaterialThin
                                                             : shader::kMaterialSolid;
    data.emission = vec3(material.emission);
    data.coverage = static_cast<float>(material.coverage);
    data.transmission = vec3(material.transmission);
    data.alphaCutoff = static_cast<float>(material.alphaCutoff);
    data.reflected = vec3(material.reflected);
    data.extinction = vec3(material.absorption + material.scattering);
    data.scattering = vec3(material.scattering);
    data.collimation = static_cast<float>(material.collimation);
    data.ior = static_cast<float>(material.ior);
    data.roughness = static_cast<float>(material.roughness);
    const dvec3 loss = material.coverage * (1.0 - material.transmission);
    for (int c = 0; c < 3; ++c)
        data.depth[c] = std::min(static_cast<float>(-std::log1p(-loss[c])), shader::kMaxDepth);
    return data;
}

shader::SphereData makeSphere(const scene::MediumSphere& sphere, std::size_t index,
                              const dvec3& origin) {
    const dvec3 center = sphere.center - origin;
    return {.center = vec3(center),
            .centerLo = roundingOf(center),
            .radius = sphere.radius,
            .tint = sphere.tint,
            .density = sphere.density,
            .medium = sphere.medium,
            .id = sphere.id,
            .profile = sphere.profile == scene::Profile::Smooth ? shader::kProfileSmooth
                                                                : shader::kProfileConstant,
            .shares = sphere.shadowing == scene::Shadowing::Particle
                          ? static_cast<std::uint32_t>(index)
                          : shader::kNoShares};
}

ImagePlane makeImagePlane(const scene::CameraFrame& camera) {
    ImagePlane plane;
    plane.corner = (camera.centerX - camera.extentX) * camera.right +
                   (camera.centerY + camera.extentY) * camera.up;
    if (camera.type != scene::CameraType::Orthographic) plane.corner += camera.forward;
    plane.pixelRight = 2 * camera.extentX / camera.width * camera.right;
    plane.pixelDown = -2 * camera.extentY / camera.height * camera.up;
    return plane;
}

}  // namespace brume::render
