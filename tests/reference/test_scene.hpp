// SPDX-License-Identifier: Apache-2.0
// Scenes of the reference's tests, made in code, and an independent way to integrate along a ray.
#pragma once

#include <reference/tracer.hpp>

#include <functional>
#include <vector>

namespace brume::reference {

/// A scene under construction together with its media.
struct TestScene {
    scene::Scene scene;
    std::vector<volumes::VolumeGrid> volumes;
    std::vector<scene::MediumSphere> spheres;

    Input input() const { return {scene, volumes, spheres}; }
    Tracer tracer(bool withShadows = true) const { return Tracer(input(), withShadows); }
    /// Radiance and transmittance along +z from `origin`.
    RayResult trace(const dvec3& origin = dvec3(0, 0, -10),
                    const dvec3& direction = dvec3(0, 0, 1)) const {
        return tracer().integrateRay({origin, glm::normalize(direction)});
    }

    std::uint32_t addMedium(const dvec3& extinction, const dvec3& albedo = dvec3(0),
                            const dvec3& emission = dvec3(0)) {
        scene::Medium medium;
        medium.extinction = extinction, medium.albedo = albedo, medium.emission = emission;
        scene.media.push_back(medium);
        return static_cast<std::uint32_t>(scene.media.size() - 1);
    }
    scene::MediumSphere& addSphere(std::uint32_t medium, const dvec3& center, double radius,
                                   scene::Profile profile = scene::Profile::Constant,
                                   double density = 1) {
        scene::MediumSphere sphere;
        sphere.center = center, sphere.radius = static_cast<float>(radius);
        sphere.density = static_cast<float>(density), sphere.medium = medium;
        sphere.profile = profile, sphere.id = static_cast<std::uint32_t>(spheres.size());
        return spheres.emplace_back(sphere);
    }
    volumes::VolumeGrid& addGrid(std::uint32_t medium, const dmat4& worldFromIndex = dmat4(1)) {
        scene::Volume volume;
        volume.medium = medium;
        scene.volumes.push_back(volume);
        volumes::VolumeGrid grid;
        grid.worldFromIndex = worldFromIndex;
        return volumes.emplace_back(grid);
    }
    void addBox(std::uint32_t medium, const dvec3& lo, const dvec3& hi, float value = 1) {
        addGrid(medium).boxes.push_back({lo, hi, value, false});
    }
    std::uint32_t addMaterial(const scene::Material& material) {
        scene.materials.push_back(material);
        return static_cast<std::uint32_t>(scene.materials.size() - 1);
    }
    /// A square in the plane z, facing -z (towards rays along +z), two triangles.
    void addPane(std::uint32_t material, double z, double halfSize = 100);
    /// A closed box with outward faces, twelve triangles.
    void addClosedBox(std::uint32_t material, const dvec3& lo, const dvec3& hi,
                      const dmat4& worldFromObject = dmat4(1));
    scene::Light& addLight(scene::LightType type, const dvec3& color, bool isShadowed = false) {
        scene::Light light;
        light.type = type, light.color = color, light.shadow = isShadowed ? "exact" : "none";
        return scene.lights.emplace_back(light);
    }
};

/// Fills a grid with one brick per 8^3 cells of [0, 8 bricks)^3 from a function of the index.
void fillBricks(volumes::VolumeGrid& grid, int bricks,
                const std::function<float(const ivec3&)>& value);

/// Extinction and emitted light per metre at a point, one channel.
struct Local {
    long double extinction = 0, light = 0;
};

/// Radiance and transmittance by the midpoint rule in extended precision between `breaks`: many
/// steps, graded towards the start of each interval, no closed form anywhere.
struct BruteForce {
    long double radiance = 0, transmittance = 1;

    void integrate(const std::function<Local(long double t)>& at, std::vector<double> breaks,
                   int stepsPerInterval = 20000);
};

}  // namespace brume::reference
