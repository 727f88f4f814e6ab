// SPDX-License-Identifier: Apache-2.0
#include <scene/camera.hpp>
#include <scene/loader_parts.hpp>
#include <scene/mesh_shapes.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace brume::scene {
namespace {

std::string textOr(const JsonNode& node, const char* key, const char* fallback) {
    return node.has(key) ? node[key].text() : fallback;
}

dvec3 readScale(const JsonNode& node) {
    constexpr double kSmallest = 1e-12, kLargest = 1e12;
    const dvec3 scale = node.json().is_number() ? dvec3(node.number()) : node.vec3();
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(scale[axis]) >= kSmallest && std::abs(scale[axis]) <= kLargest))
            throw node.error(
                fmt::format("has a size of {}, must be from {} to {} (negative mirrors)",
                            std::abs(scale[axis]), kSmallest, kLargest));
    return scale;
}

Settings readSettings(const JsonNode& node) {
    Settings settings;
    for (const auto& [key, value] : node.members())
        settings[key] = value.json().is_string() ? value.text()
                               : value.json().is_number_float()
                                   ? fmt::format("{}", value.number())
                                   : value.json().dump();
    return settings;
}

void readTextFields(const JsonNode& node, Light& light) {
    node.read("shadow", light.shadow);
    if (node.has("shadowSettings")) light.shadowSettings = readSettings(node["shadowSettings"]);
    if (node.has("direction")) light.direction = node["direction"].unitVec3();
}

}  // namespace

Camera readCamera(const JsonNode& node) {
    Camera camera;
    if (textOr(node, "type", "perspective") == "orthographic")
        camera.type = CameraType::Orthographic;
    node.read("position", camera.position);
    node.read("target", camera.target);
    node.read("up", camera.up);
    node.read("near", camera.near);
    node.read("height", camera.height);
    node.readRadians("verticalFov", camera.verticalFov);
    try {
        makeCameraFrame(camera, 1, 1);
    } catch (const Error& error) {
        const std::string message = error.what();
        throw node.error(message.substr(message.rfind(": ") + 2));
    }
    return camera;
}

ImageSettings readImageSettings(const JsonNode& node) {
    ImageSettings image;
    node.read("width", image.width);
    node.read("height", image.height);
    node.read("supersample", image.supersample);
    return image;
}

Light readLight(const JsonNode& node) {
    Light light;
    const std::string type = node["type"].text();
    light.type = type == "ambient"       ? LightType::Ambient
                 : type == "directional" ? LightType::Directional
                 : type == "point"       ? LightType::Point
                                         : LightType::Spot;
    for (const char* key : {"radiance", "irradiance", "intensity"}) node.read(key, light.color);
    readTextFields(node, light);
    node.read("position", light.position);
    node.read("radius", light.radius);
    node.readRadians("innerAngle", light.innerAngle);
    node.readRadians("outerAngle", light.outerAngle);
    if (light.innerAngle > light.outerAngle)
        throw(node.has("innerAngle") ? node["innerAngle"] : node["outerAngle"])
            .error(fmt::format("innerAngle {:g} is above outerAngle {:g}, must be at most that",
                               light.innerAngle * 180 / kPi, light.outerAngle * 180 / kPi));
    return light;
}

Material readMaterial(const JsonNode& node) {
    Material material;
    const std::string type = node["type"].text();
    material.type = type == "opaque" ? MaterialType::Opaque
                    : type == "thin" ? MaterialType::Thin
                                     : MaterialType::Solid;
    node.read("albedo", material.albedo);
    node.read("emission", material.emission);
    node.read("coverage", material.coverage);
    node.read("transmission", material.transmission);
    node.read("reflected", material.reflected);
    node.read("collimation", material.collimation);
    node.read("ior", material.ior);
    node.read("roughness", material.roughness);
    node.read("absorption", material.absorption);
    node.read("scattering", material.scattering);
    node.read("alphaCutoff", material.alphaCutoff);
    return material;
}

Medium readMedium(const JsonNode& node) {
    Medium medium;
    node.read("extinction", medium.extinction);
    node.read("albedo", medium.albedo);
    node.read("emission", medium.emission);
    if (node.has("phase")) {
        const JsonNode phase = node["phase"];
        const std::string type = phase["type"].text();
        medium.phase = type == "rayleigh"            ? PhaseType::Rayleigh
                       : type == "henyey_greenstein" ? PhaseType::HenyeyGreenstein
                                                     : PhaseType::Isotropic;
        phase.read("g", medium.g);
    }
    return medium;
}

RenderSettings readRenderSettings(const JsonNode& node) {
    RenderSettings render;
    node.read("method", render.method);
    if (node.has("settings")) render.settings = readSettings(node["settings"]);
    return render;
}

dmat4 readTransform(const JsonNode& parent) {
    dvec3 translate(0), degrees(0), scale(1);
    if (parent.has("transform")) {
        const JsonNode node = parent["transform"];
        node.read("translate", translate);
        node.read("rotate", degrees);
        if (node.has("scale")) scale = readScale(node["scale"]);
    }
    dmat4 matrix = glm::translate(dmat4(1), translate);
    for (int axis : {2, 1, 0}) {
        dvec3 about(0);
        about[axis] = 1;
        matrix = glm::rotate(matrix, radians(degrees[axis]), about);
    }
    return glm::scale(matrix, scale);
}

Path readPath(const JsonNode& parent) {
    Path path;
    for (const JsonNode& item : parent.items("path")) {
        const std::vector<JsonNode> pair = item.items();
        if (!path.empty() && !(pair[0].number() > path.back().first))
            throw pair[0].error("is not above the time before it, times must rise");
        path.emplace_back(pair[0].number(), pair[1].vec3());
    }
    return path;
}

Mesh readShape(const JsonNode& node) {
    const std::string shape = node["shape"].text();
    Mesh mesh;
    if (shape == "plane") {
        mesh = makePlane(node["size"].vec2());
    } else if (shape == "box") {
        mesh = makeBox(node["size"].vec3());
    } else {
        int segments = 64;
        node.read("segments", segments);
        if (segments % 2 != 0)
            throw node["segments"].error(fmt::format("is {}, must be even", segments));
        mesh = makeSphere(node["radius"].number(), segments);
    }
    mesh.name = node.path();
    placeMesh(mesh, readTransform(node));
    return mesh;
}

}  // namespace brume::scene
