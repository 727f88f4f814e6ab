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

}  // namespace brume::particles
