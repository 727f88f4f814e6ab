// SPDX-License-Identifier: Apache-2.0
// Putting built-in scenes together, a line per thing.
#pragma once

#include <scene/mesh_shapes.hpp>
#include <scene/scene.hpp>

#include <utility>

namespace brume::bench {

/// At a place, turned by degrees around y, then around its own x.
inline dmat4 place(const dvec3& at, double yaw = 0, double pitch = 0) {
    dmat4 m = glm::translate(dmat4(1), at);
    m = glm::rotate(m, radians(yaw), dvec3(0, 1, 0));
    return glm::rotate(m, radians(pitch), dvec3(1, 0, 0));
}

/// A scene under construction, seen from +z.
struct SceneBuilder {
    scene::Scene scene;

    SceneBuilder(const dvec3& eye, const dvec3& target, double fov) {
        scene.image = {640, 360, 1};
        scene.camera.position = eye;
        scene.camera.target = target;
        scene.camera.verticalFov = radians(fov);
    }

    std::uint32_t add(const scene::Material& material) {
        scene.materials.push_back(material);
        return static_cast<std::uint32_t>(scene.materials.size() - 1);
    }
    std::uint32_t addOpaque(const dvec3& albedo, const dvec3& emission = dvec3(0)) {
        scene::Material m;
        m.albedo = albedo;
        m.emission = emission;
        return add(m);
    }
    std::uint32_t addThin(double coverage, const dvec3& transmission, const dvec3& reflected,
                          double collimation = 1) {
        scene::Material m;
        m.type = scene::MaterialType::Thin;
        m.coverage = coverage;
        m.transmission = transmission;
        m.reflected = reflected;
        m.collimation = collimation;
        return add(m);
    }
    std::uint32_t addGlass(const dvec3& absorption) {
        scene::Material m;
        m.type = scene::MaterialType::Solid;
        m.absorption = absorption;
        return add(m);
    }
    std::uint32_t addMedium(double extinction, const dvec3& albedo) {
        scene::Medium medium;
        medium.extinction = dvec3(extinction);
        medium.albedo = albedo;
        scene.media.push_back(medium);
        return static_cast<std::uint32_t>(scene.media.size() - 1);
    }
    void addMesh(scene::Mesh mesh, std::uint32_t material, const dmat4& transform) {
        mesh.material = material;
        scene::placeMesh(mesh, transform);
        scene.meshes.push_back(std::move(mesh));
    }
    /// A rectangle that faces +z.
    void addPane(std::uint32_t material, const dvec2& size, const dvec3& at, double yaw = 0) {
        addMesh(scene::makePlane(size), material, place(at, yaw, 90));
    }
    void addBox(std::uint32_t material, const dvec3& size, const dvec3& at) {
        addMesh(scene::makeBox(size), material, place(at));
    }
    void addSphere(std::uint32_t medium, const dvec3& center, double radius, double density) {
        scene.spheres.push_back(
            {center, radius, medium, density, scene::Profile::Smooth});
    }
    void addPoint(const dvec3& position, const dvec3& intensity) {
        scene::Light light;
        light.type = scene::LightType::Point;
        light.position = position;
        light.color = intensity;
        light.radius = 0.1;
        scene.lights.push_back(light);
    }
    void addAmbient(const dvec3& radiance) {
        scene::Light light;
        light.color = radiance;
        scene.lights.push_back(light);
    }
};

}  // namespace brume::bench
