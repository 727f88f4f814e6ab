// SPDX-License-Identifier: Apache-2.0
// Effects that several tests use.
#pragma once

#include <scene/effect.hpp>

namespace brume::particles {

inline scene::ModuleSettings moduleSettings(
    const std::string& type, std::map<std::string, std::vector<double>> values = {}) {
    return {.type = type, .values = std::move(values), .where = "test.effect.json:3:5"};
}

/// `count` particles at the origin at time 0 with one velocity, living for ever.
inline scene::Effect burstEffect(std::uint32_t count, double speed = 0,
                                 const dvec3& direction = {0, 1, 0}) {
    scene::Effect effect;
    effect.capacity = std::max(count, 1u);
    effect.emitters = {{.bursts = {{0, count}},
                        .speed = dvec2(speed),
                        .direction = direction,
                        .lifetime = dvec2(1e6)}};
    return effect;
}

/// A grid over [-4, 4]^3 m, `edge` voxels wide, with `value` of each voxel's place.
template <typename Value>
inline std::shared_ptr<const scene::FieldValues> makeField(int edge, int components,
                                                           const Value& value) {
    auto field = std::make_shared<scene::FieldValues>();
    field->size = ivec3(edge);
    field->lo = {-3, 2, 5};
    field->componentCount = components;
    field->fileFromIndex = glm::translate(dmat4(1), dvec3(-4)) *
                           glm::scale(dmat4(1), dvec3(8.0 / (edge - 1))) *
                           glm::translate(dmat4(1), -dvec3(field->lo));
    for (int z = 0; z < edge; ++z)
        for (int y = 0; y < edge; ++y)
            for (int x = 0; x < edge; ++x) {
                const dvec3 place = transformPoint(field->fileFromIndex,
                                                   dvec3(field->lo + ivec3(x, y, z)));
                const dvec3 values = value(place);
                for (int i = 0; i < components; ++i)
                    field->values.push_back(static_cast<float>(values[i]));
            }
    return field;
}

/// Air that turns around Y with an updraft, 1 rad/s.
inline dvec3 swirl(const dvec3& p) { return {p.z, 0.5, -p.x}; }

/// Grids "velocity" (staggered), "temperature", "density" and "ball", a level set of radius 1.2 m.
inline void addTestFields(scene::Effect& effect) {
    const auto add = [&](const char* grid, scene::FieldValues field) {
        effect.fields[{"test.vdb", grid, -1}] =
            std::make_shared<const scene::FieldValues>(std::move(field));
    };
    scene::FieldValues velocity = *makeField(9, 3, swirl);
    velocity.isStaggered = true;
    add("velocity", velocity);
    add("temperature", *makeField(11, 1, [](const dvec3& p) { return dvec3(2 - 0.4 * p.y); }));
    add("density", *makeField(9, 1, [](const dvec3& p) {
        return dvec3(std::max(1 - glm::length(p) / 3, 0.0));
    }));
    scene::FieldValues ball =
        *makeField(41, 1, [](const dvec3& p) { return dvec3(glm::length(p) - 1.2); });
    ball.isLevelSet = true;
    ball.background = 3;
    ball.surface = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}}};
    add("ball", ball);
}

inline scene::FieldPlacement placeField(const char* grid) {
    return {.source = {"test.vdb", grid, -1}, .where = "test.effect.json:9:9"};
}

/// A module that samples one of the test's grids.
inline scene::ModuleSettings fieldModule(const std::string& type, const std::string& grid,
                                         std::map<std::string, std::vector<double>> values = {}) {
    scene::ModuleSettings settings = moduleSettings(type, std::move(values));
    settings.texts = {{"file", "test.vdb"}, {"grid", grid}};
    return settings;
}

/// Every module, every shape, bursts and rates, short and long lives.
inline scene::Effect busyEffect(std::uint32_t capacity = 6000) {
    scene::Effect effect;
    effect.capacity = capacity;
    effect.emitters = {
        {.rate = 700, .bursts = {}, .speed = {1, 3}, .spread = 0.4, .lifetime = {0.001, 2}},
        {.rate = 333.3,
         .bursts = {{0, 100}, {0.5021, 200}},
         .duration = 4,
         .shape = scene::EmitterShape::Sphere,
         .position = {1, 2, 3},
         .radius = 0.5,
         .speed = {0, 2},
         .direction = {1, 1, 0},
         .spread = kPi,
         .lifetime = {1, 3}},
        {.rate = 450,
         .bursts = {},
         .shape = scene::EmitterShape::Box,
         .position = {-2, 0, 0},
         .size = {1, 2, 3},
         .speed = {5, 5},
         .direction = {0, 0, -1},
         .lifetime = {0.5, 0.7}},
        {.bursts = {{1, 500}, {1.001, 10}, {3, 500}},
         .shape = scene::EmitterShape::Disc,
         .radius = 2,
         .speed = {-1, 1},
         .direction = {0.3, -1, 0.2},
         .spread = 0.01,
         .lifetime = {0.2, 5}}};
    effect.modules = {
        moduleSettings("gravity"),
        moduleSettings("drag", {{"rate", {0.7}}, {"wind", {2, 0.5, -1}}}),
        moduleSettings("curl_noise", {{"strength", {6}}, {"scale", {0.8}}, {"octaves", {3}}}),
        moduleSettings("curl_noise", {{"strength", {1}}, {"scale", {0.1}}})};
    effect.radius.keys = {{0, 0.05}, {0.3, 0.1}, {1, 0.3}};
    effect.density.keys = {{0, 1}, {1, 0.2}};
    effect.tint.keys = {{0, dvec3(1)}, {0.5, dvec3(1, 0.5, 0.2)}, {1, dvec3(0.5)}};
    return effect;
}

/// busyEffect() with every shape, force, collider and killer, and with sub-emitters of every kind.
inline scene::Effect fullEffect(std::uint32_t capacity = 2000) {
    using scene::EmitterShape, scene::EmitterVelocity;
    const auto word = [](scene::ModuleSettings settings, const std::string& key,
                         const std::string& value) {
        settings.texts[key] = value;
        return settings;
    };
    scene::Effect effect = busyEffect(capacity);
    for (scene::Emitter& emitter : effect.emitters) {
        emitter.rate *= 0.3;
        emitter.path = {{0, dvec3(0)}, {0.4, dvec3(1, 0.5, 0)}, {0.9, dvec3(-1, 0, 2)}};
        emitter.inherit = 0.5;
    }
    const auto add = [&](EmitterShape shape, EmitterVelocity velocity, bool fromSurface) {
        effect.emitters.push_back({.rate = 60,
                                   .bursts = {{0.1, 7, 1000, 0.13}},
                                   .delay = 0.2,
                                   .shape = shape,
                                   .radius = 0.7,
                                   .innerRadius = 0.2,
                                   .height = 1.5,
                                   .normal = glm::normalize(dvec3(1, 2, -1)),
                                   .size = {1, 0.5, 0.25},
                                   .fromSurface = fromSurface,
                                   .speed = {1, 4},
                                   .velocity = velocity,
                                   .direction = glm::normalize(dvec3(0.2, 1, 0.4)),
                                   .spread = 0.3,
                                   .lifetime = {0.3, 2}});
        effect.emitters.back().triangles =
            std::make_shared<const std::vector<scene::EmitterTriangle>>(
                std::vector<scene::EmitterTriangle>{
                    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 0}, {0, 1, 0}, {0, 0, 0.3}}});
    };
    add(EmitterShape::Line, EmitterVelocity::Direction, false);
    add(EmitterShape::Ring, EmitterVelocity::Normal, false);
    add(EmitterShape::Sphere, EmitterVelocity::Radial, true);
    add(EmitterShape::Box, EmitterVelocity::Normal, true);
    add(EmitterShape::Cone, EmitterVelocity::Normal, true);
    add(EmitterShape::Cone, EmitterVelocity::Radial, false);
    add(EmitterShape::Mesh, EmitterVelocity::Normal, false);
    add(EmitterShape::Volume, EmitterVelocity::Direction, false);
    effect.emitters.back().volume = placeField("density");
    effect.emitters.back().velocityField = placeField("velocity");
    add(EmitterShape::Volume, EmitterVelocity::Normal, false);
    effect.emitters.back().volume = placeField("ball");
    addTestFields(effect);
    effect.modules[2].values["drift"] = {0.5, -3, 1};
    for (const scene::ModuleSettings& module :
         {moduleSettings("quadratic_drag", {{"coefficient", {0.05}}, {"wind", {0, 1, 0}}}),
          moduleSettings("vortex", {{"circulation", {6}}, {"inflow", {0.2}}, {"updraft", {0.3}},
                                    {"length", {5}}, {"rate", {2}}, {"axis", {0.1, 1, 0.3}}}),
          moduleSettings("attractor", {{"center", {2, 1, 0}}, {"strength", {5}},
                                       {"killRadius", {0.1}}}),
          moduleSettings("attractor", {{"center", {-2, 0, 0}}, {"axis", {0, 1, 0.5}},
                                       {"strength", {-1}}, {"falloff", {1}}}),
          moduleSettings("attractor", {{"strength", {0.1}}, {"falloff", {-1}}}),
          moduleSettings("collide_plane", {{"point", {0, -2, 0}}, {"restitution", {0.7}},
                                           {"radius", {0.05}}}),
          word(moduleSettings("collide_plane", {{"point", {0, 0, -6}}, {"normal", {0.1, 0, 1}}}),
               "response", "stick"),
          moduleSettings("collide_sphere", {{"center", {0, -1.5, 0}}, {"size", {1}}}),
          word(moduleSettings("collide_sphere", {{"size", {7}}, {"restitution", {1}}}), "side",
               "inside"),
          moduleSettings("collide_box", {{"center", {1.5, -1, 1}}, {"size", {1, 0.2, 2}},
                                         {"rotate", {10, 20, 30}}}),
          word(moduleSettings("collide_box", {{"size", {12, 12, 12}}, {"rotate", {0, 45, 0}}}),
               "side", "inside"),
          moduleSettings("collide_capsule", {{"from", {-2, -1, 1}}, {"to", {-1, 0, 2}},
                                             {"size", {0.3}}, {"friction", {0.6}}}),
          word(moduleSettings("kill_box", {{"size", {13, 13, 13}}}), "side", "inside"),
          moduleSettings("kill_sphere", {{"center", {3, 3, 3}}, {"size", {0.7}}}),
          fieldModule("velocity_field", "velocity", {{"strength", {0.4}}}),
          word(fieldModule("velocity_field", "velocity", {{"rate", {0.5}}, {"scale", {2}}}), "mode",
               "drag"),
          fieldModule("buoyancy", "temperature", {{"lift", {0.1, 0.8, 0}}, {"ambient", {0.5}}}),
          fieldModule("collide_level_set", "ball", {{"position", {2.5, 0.3, -1}},
                                                    {"scale", {0.5}}, {"radius", {0.03}}}),
          moduleSettings("kill_plane", {{"point", {0, -5, 0}}, {"normal", {0, 1, 0.1}}})})
        effect.modules.push_back(module);

    const auto child = std::make_shared<scene::Effect>(burstEffect(1));
    child->capacity = capacity;
    child->emitters = {{.bursts = {},
                        .shape = EmitterShape::Sphere,
                        .radius = 0.02,
                        .inherit = 0.3,
                        .speed = {0, 2},
                        .velocity = EmitterVelocity::Radial,
                        .spread = 1,
                        .lifetime = {0.01, 0.4}}};
    child->modules = {moduleSettings("gravity"),
                      moduleSettings("collide_plane", {{"point", {0, -2, 0}}})};
    const auto grandchild = std::make_shared<scene::Effect>(*child);
    child->subEmitters = {{.trigger = scene::SubEmitterTrigger::Death, .count = {0, 1.5},
                           .effect = grandchild}};
    using Trigger = scene::SubEmitterTrigger;
    effect.subEmitters = {
        {.trigger = Trigger::Birth, .count = {0, 2}, .effect = child},
        {.trigger = Trigger::Death, .count = {3, 3}, .effect = grandchild},
        {.trigger = Trigger::Collision, .count = dvec2(0.7), .effect = grandchild},
        {.trigger = Trigger::Way, .rate = 17, .effect = grandchild}};
    return effect;
}

}  // namespace brume::particles
