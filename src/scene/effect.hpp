// SPDX-License-Identifier: Apache-2.0
// A particle effect as plain structs: the effect file with every default filled in.
#pragma once

#include <core/math.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace brume::scene {

enum class EmitterShape { Point, Sphere, Box, Disc };

struct Burst {
    double time = 0;  ///< s
    std::uint32_t count = 0;
};

struct Emitter {
    double rate = 0;  ///< particles per second
    std::vector<Burst> bursts;
    double duration = kInfinity;  ///< s; rate and bursts stop afterwards
    EmitterShape shape = EmitterShape::Point;
    dvec3 position{0};         ///< centre of the shape, effect space
    double radius = 0;         ///< sphere (births in its volume), disc (births on its area)
    dvec3 normal{0, 1, 0};     ///< disc, unit
    dvec3 size{0};             ///< box, full edge lengths
    dvec2 speed{0};            ///< m/s, [low, high]
    dvec3 direction{0, 1, 0};  ///< unit
    double spread = 0;         ///< half angle of the cone around direction, radians
    dvec2 lifetime{1};         ///< s, [low, high]
};

/// One simulation module: its type name and its settings, checked against the module's own table
/// (particles/modules) when the effect is loaded for simulation. All numbers are finite.
struct ModuleSettings {
    std::string type;
    std::map<std::string, std::vector<double>>
        values;  ///< numbers, size 1; vectors; true and false, 1 and 0
    std::map<std::string, std::string> texts;    ///< strings
    std::map<std::string, std::string> whereOf;  ///< file:line:column of each key's value
    std::string where;                           ///< file:line:column of the module, for messages
};

/// Piecewise linear over normalised age in [0, 1]; keys sorted, at least one.
template <typename T>
struct Curve {
    std::vector<std::pair<double, T>> keys;
};

struct Effect {
    std::uint32_t capacity = 10000;
    double tickRate = 120;  ///< simulation steps per second
    std::string medium;     ///< name in the scene that uses the effect
    std::vector<Emitter> emitters;
    std::vector<ModuleSettings> modules;
    Curve<double> radius{{{0, 0.05}}};
    Curve<double> density{{{0, 1}}};
    Curve<dvec3> tint{{{0, dvec3(1)}}};  ///< multiplies albedo and emission of the medium
    bool smoothProfile = false;
};

}  // namespace brume::scene
