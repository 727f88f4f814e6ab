// SPDX-License-Identifier: Apache-2.0
#include <particles/appearance_curves.hpp>
#include <render/needs.hpp>
#include <shadows/store_info.hpp>

#include <shaders/shadows/common/maps.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>

namespace brume::render {
namespace {

bool isGrey(const dvec3& v) { return v.x == v.y && v.y == v.z; }

void addThinNeeds(const scene::Material& material, oit::Needs& needs) {
    const bool transmits = material.transmission != dvec3(0);
    if (!isGrey(material.transmission) || (transmits && material.colorTexture))
        needs.colouredSurfaces = true;
    if (material.collimation < 1) needs.diffusion = true;
}

void addSurfaceNeeds(const scene::Scene& scene, oit::Needs& needs) {
    for (const scene::Mesh& mesh : scene.meshes) {
        const scene::Material& material = scene.materials[mesh.material];
        if (material.type == scene::MaterialType::Opaque) {
            needs.opaque = true;
            continue;
        }
        needs.surfaces = true;
        if (material.roughness >= 0) needs.glossy = true;
        if (material.type == scene::MaterialType::Solid) needs.solids = true;
        if (material.type == scene::MaterialType::Thin) addThinNeeds(material, needs);
        if (material.type == scene::MaterialType::Solid &&
            !isGrey(material.absorption + material.scattering))
            needs.colouredExtinction = true;
    }
}

void addVolumeNeeds(const PreparedScene& prepared, oit::Needs& needs) {
    for (std::size_t i = 0; i < prepared.volumes.size(); ++i) {
        const volumes::VolumeGrid& grid = prepared.volumes[i];
        if (prepared.scene.volumes[i].representation == scene::VolumeRepresentation::Particles)
            continue;
        if (grid.isEmpty()) continue;
        needs.boxes = true;
        if (!grid.bricks.empty()) needs.varyingDensity = true;
        if (std::any_of(grid.boxes.begin(), grid.boxes.end(),
                        [](const auto& box) { return box.soft; }))
            needs.varyingDensity = true;
    }
}

/// The tints of spheres, of particles too: at most two, as more say no more.
std::set<std::array<float, 3>> findTints(const PreparedScene& prepared) {
    std::set<std::array<float, 3>> tints;
    const auto add = [&](const vec3& tint) {
        if (tints.size() < 2) tints.insert({tint.x, tint.y, tint.z});
    };
    for (const scene::MediumSphere& sphere : prepared.spheres) add(sphere.tint);
    for (const scene::EffectInstance& instance : prepared.scene.effects) {
        if (instance.effect.surface) continue;
        const std::optional<vec3> tint = particles::constantTint(instance.effect);
        add(tint.value_or(vec3(1)));
        if (!tint) add(vec3(0));
    }
    return tints;
}

/// Whether one medium and one tint are all there is.
bool hasOneMedium(const PreparedScene& prepared) {
    std::set<std::uint32_t> media;
    std::set<std::array<float, 3>> tints = findTints(prepared);
    for (const scene::MediumSphere& sphere : prepared.spheres) media.insert(sphere.medium);
    for (const scene::EffectInstance& instance : prepared.scene.effects)
        if (!instance.effect.surface) media.insert(instance.medium);
    for (std::size_t i = 0; i < prepared.volumes.size(); ++i) {
        if (prepared.volumes[i].isEmpty()) continue;
        media.insert(prepared.scene.volumes[i].medium);
        tints.insert({1, 1, 1});
    }
    return media.size() == 1 && tints.size() == 1;
}

/// How media and solids that scatter are shadowed; 0: none scatters.
std::uint32_t findShadowing(const PreparedScene& prepared) {
    const scene::Scene& scene = prepared.scene;
    const auto scatters = [&](std::uint32_t medium) {
        return scene.media[medium].albedo * scene.media[medium].extinction != dvec3(0);
    };
    std::uint32_t shadowing = 0;
    const auto add = [&](std::uint32_t medium, scene::Shadowing kind) {
        if (scatters(medium))
            shadowing |= kind == scene::Shadowing::Particle ? shader::kShadowingWhole
                                                            : shader::kShadowingSampled;
    };
    for (const scene::MediumSphere& sphere : prepared.spheres) add(sphere.medium, sphere.shadowing);
    for (const scene::EffectInstance& effect : scene.effects)
        if (!effect.effect.surface) add(effect.medium, effect.effect.shadowing);
    for (const scene::Volume& volume : scene.volumes)
        if (volume.representation != scene::VolumeRepresentation::Particles)
            add(volume.medium, scene::Shadowing::Sample);
    for (const scene::Mesh& mesh : scene.meshes) {
        const scene::Material& material = scene.materials[mesh.material];
        if (material.type == scene::MaterialType::Solid && material.scattering != dvec3(0))
            shadowing |= shader::kShadowingSampled;
    }
    return shadowing;
}

float findLargestTint(const PreparedScene& prepared) {
    float largest = 1;
    const auto extend = [&](const vec3& tint) {
        largest = std::max({largest, tint.x, tint.y, tint.z});
    };
    for (const scene::MediumSphere& sphere : prepared.spheres) extend(sphere.tint);
    for (const scene::EffectInstance& effect : prepared.scene.effects)
        largest = std::max(largest, particles::largestTint(effect.effect));
    return largest;
}

}  // namespace

oit::Needs findNeeds(const PreparedScene& prepared) {
    const scene::Scene& scene = prepared.scene;
    oit::Needs needs;
    needs.spheres = !prepared.spheres.empty() ||
                    std::any_of(scene.effects.begin(), scene.effects.end(),
                                [](const auto& effect) { return !effect.effect.surface; });
    for (const scene::MediumSphere& sphere : prepared.spheres)
        (sphere.profile == scene::Profile::Smooth ? needs.varyingDensity : needs.uniformSpheres) =
            true;
    for (const scene::EffectInstance& effect : scene.effects)
        (effect.effect.smoothProfile ? needs.varyingDensity : needs.uniformSpheres) = true;
    addVolumeNeeds(prepared, needs);
    addSurfaceNeeds(scene, needs);
    for (const scene::Material& material : scene.materials)
        if (material.colorTexture || material.emissionTexture) needs.textured = true;
    needs.environment = scene.background.environment != nullptr;
    needs.media = static_cast<std::uint32_t>(scene.media.size());
    for (const scene::Medium& medium : scene.media)
        if (!isGrey(medium.extinction)) needs.colouredExtinction = true;
    const std::uint32_t shadowing = findShadowing(prepared);
    const bool isSampled = (shadowing & shader::kShadowingSampled) != 0;
    for (const scene::Light& light : scene.lights) {
        if (light.type == scene::LightType::Ambient) continue;
        ++needs.lights;
        needs.shadowStores |= shadows::storeBits(light.shadow);
        if (light.type != scene::LightType::Directional) needs.pointLights = true;
        if (light.type != scene::LightType::Directional && shadowing != 0)
            needs.lamps = needs.varyingLight = true;
        if (light.shadow != "none" && isSampled) needs.varyingLight = true;
    }
    if (needs.shadowStores != 0) needs.shadowing = shadowing;
    needs.wholeShadows = (needs.shadowing & shader::kShadowingWhole) != 0;
    needs.tinted = findTints(prepared).size() > 1;
    needs.oneMedium = hasOneMedium(prepared);
    needs.oneSource = needs.oneMedium && !needs.varyingLight && !needs.wholeShadows;
    needs.largestTint = findLargestTint(prepared);
    needs.orthographic = scene.camera.type == scene::CameraType::Orthographic;
    return needs;
}

std::string describe(const oit::Needs& needs) {
    const auto line = [](const char* name, bool used, const char* meaning) {
        return fmt::format("  {:<20} {:<4} {}\n", name, used ? "yes" : "no", meaning);
    };
    return "needs\n" + line("spheres", needs.spheres, "soft spheres of particles or the scene") +
           line("boxes", needs.boxes, "bricks, tiles or boxes of volumes") +
           line("surfaces", needs.surfaces, "thin or solid glass, cards") +
           line("opaque", needs.opaque, "opaque meshes, or what a host has drawn") +
           line("solids", needs.solids, "closed meshes of glass") +
           line("varyingDensity", needs.varyingDensity, "densities that change along a ray") +
           line("varyingLight", needs.varyingLight,
                "on media: point or spot lights, or shadows at each place") +
           line("lamps", needs.lamps, "point or spot lights on media") +
           line("pointLights", needs.pointLights, "point or spot lights") +
           line("wholeShadows", needs.wholeShadows, "spheres that are shadowed as a whole") +
           line("colouredExtinction", needs.colouredExtinction,
                "three exponentials instead of one") +
           line("colouredSurfaces", needs.colouredSurfaces, "thin surfaces that transmit colours") +
           line("environment", needs.environment, "a picture behind everything") +
           line("textured", needs.textured, "materials with textures") +
           line("glossy", needs.glossy, "glass mirrors background and lights") +
           line("diffusion", needs.diffusion, "frosted surfaces blur what is behind them") +
           line("tinted", needs.tinted, "spheres of different tints") +
           line("oneMedium", needs.oneMedium, "one medium and tint in the whole scene") +
           line("oneSource", needs.oneSource, "and the same light everywhere: order is no matter") +
           line("orthographic", needs.orthographic, "parallel rays") +
           fmt::format("  {:<20} {:<4} directional, point and spot lights\n", "lights",
                       needs.lights) +
           line("shadows", needs.shadowStores != 0, "maps of what the lights see");
}

}  // namespace brume::render
