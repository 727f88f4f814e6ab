// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <particles/modules/collider_keys.hpp>

namespace brume::particles {
namespace {

ModuleKey sideKey(const std::string& summary) {
    return {.name = "side",
            .unit = "word",
            .summary = summary,
            .fallback = {},
            .choices = {"outside", "inside"}};
}

}  // namespace

std::vector<ModuleKey> withSurfaceKeys(std::vector<ModuleKey> keys) {
    keys.insert(
        keys.end(),
        {{.name = "response",
          .unit = "word",
          .summary = "what a hit does",
          .fallback = {},
          .choices = {"bounce", "stick", "kill"}},
         {.name = "restitution",
          .unit = "1",
          .summary = "speed along the normal after a hit by that before",
          .fallback = {0.3},
          .lo = 0,
          .hi = 1},
         {.name = "friction",
          .unit = "1",
          .summary = "Coulomb's coefficient",
          .fallback = {0.2},
          .lo = 0,
          .hi = 1e3},
         {.name = "radius",
          .unit = "m",
          .summary = "of the particles, as far as the surface is concerned",
          .fallback = {0},
          .lo = 0,
          .hi = 1e3}});
    return keys;
}

shader::ContactSurface contactSurface(const ModuleValues& values) {
    return {static_cast<float>(values.number("restitution")),
            static_cast<float>(values.number("friction")), values.choice("response")};
}

shader::ContactSurface killingSurface() { return {0, 0, shader::kResponseKill}; }

shader::PlaneCollider& addPlane(const ModuleValues& values, ModuleSums& sums, double radius) {
    shader::EffectParameters& parameters = *sums.parameters;
    shader::PlaneCollider& plane =
        appendModule(values, "plane", parameters.planeColliderCount, parameters.planeCollider);
    const dvec3 normal = values.vector("normal");
    plane.normal = vec3(normal);
    plane.offset = static_cast<float>(glm::dot(normal, values.vector("point")) + radius);
    return plane;
}

shader::SphereCollider& addSphere(const ModuleValues& values, ModuleSums& sums, double radius) {
    shader::EffectParameters& parameters = *sums.parameters;
    shader::SphereCollider& sphere =
        appendModule(values, "sphere", parameters.sphereColliderCount, parameters.sphereCollider);
    sphere.center = vec3(values.vector("center"));
    sphere.isHollow = values.choice("side");
    const double size = values.number("size") + (sphere.isHollow ? -radius : radius);
    sphere.radius = static_cast<float>(std::max(size, 0.0));
    return sphere;
}

shader::BoxCollider& addBox(const ModuleValues& values, ModuleSums& sums, double radius) {
    shader::EffectParameters& parameters = *sums.parameters;
    shader::BoxCollider& box =
        appendModule(values, "box", parameters.boxColliderCount, parameters.boxCollider);
    // As in docs/formats.md, Transform: about X, then Y, then Z.
    const dvec3 angles = values.vector("rotate") * (kPi / 180);
    const dmat4 turn = glm::rotate(dmat4(1), angles.z, dvec3(0, 0, 1)) *
                       glm::rotate(dmat4(1), angles.y, dvec3(0, 1, 0)) *
                       glm::rotate(dmat4(1), angles.x, dvec3(1, 0, 0));
    box.center = vec3(values.vector("center"));
    box.axisX = vec3(dvec3(turn[0]));
    box.axisY = vec3(dvec3(turn[1]));
    box.axisZ = vec3(dvec3(turn[2]));
    box.isHollow = values.choice("side");
    box.extent = vec3(
        glm::max(0.5 * values.vector("size") + (box.isHollow ? -radius : radius), dvec3(0)));
    return box;
}

std::vector<ModuleKey> planeKeys() {
    return {{.name = "point",
             .unit = "m",
             .summary = "a point of the plane",
             .fallback = {0, 0, 0},
             .lo = -1e6,
             .hi = 1e6},
            {.name = "normal",
             .unit = "1",
             .summary = "towards the side where particles may be",
             .fallback = {0, 1, 0},
             .lo = -1e9,
             .hi = 1e9,
             .isDirection = true}};
}

std::vector<ModuleKey> sphereKeys() {
    return {{.name = "center",
             .unit = "m",
             .summary = "of the sphere",
             .fallback = {0, 0, 0},
             .lo = -1e6,
             .hi = 1e6},
            {.name = "size",
             .unit = "m",
             .summary = "radius of the sphere",
             .fallback = {1},
             .lo = 1e-4,
             .hi = 1e6},
            sideKey("where particles may be")};
}

std::vector<ModuleKey> boxKeys() {
    return {{.name = "center",
             .unit = "m",
             .summary = "of the box",
             .fallback = {0, 0, 0},
             .lo = -1e6,
             .hi = 1e6},
            {.name = "size",
             .unit = "m",
             .summary = "full edge lengths",
             .fallback = {1, 1, 1},
             .lo = 1e-4,
             .hi = 1e6},
            {.name = "rotate",
             .unit = "degrees",
             .summary = "about X, then Y, then Z",
             .fallback = {0, 0, 0},
             .lo = -1e6,
             .hi = 1e6},
            sideKey("where particles may be")};
}

}  // namespace brume::particles
