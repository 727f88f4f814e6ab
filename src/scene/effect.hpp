// SPDX-License-Identifier: Apache-2.0
// A particle effect as plain structs: the effect file with every default filled in.
#pragma once

#include <core/math.hpp>
#include <scene/placement.hpp>

#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace brume::scene {

enum class EmitterShape { Point, Line, Disc, Ring, Sphere, Box, Cone, Mesh, Volume };

/// What the cone of velocities is around.
enum class EmitterVelocity {
    Direction,  ///< Emitter::direction
    Radial,     ///< the way from the emitter's position to the place of birth
    Normal      ///< the normal of the shape there
};

struct Burst {
    double time = 0;  ///< s, after the emitter's delay
    std::uint32_t count = 0;
    std::uint32_t repeat = 1;  ///< times in all
    double interval = 0;       ///< s, from one time to the next
};

/// A triangle that emits, counter-clockwise seen from outside.
struct EmitterTriangle {
    dvec3 a{0}, b{0}, c{0};
};

/// A grid of a VDB file.
struct FieldSource {
    std::string file;    ///< absolute path
    std::string grid;    ///< its name
    int gridIndex = -1;  ///< among the grids of that name; -1: the only one
    auto operator<=>(const FieldSource&) const = default;
};

/// The values of a grid, dense over its active box.
struct FieldValues {
    ivec3 lo{0};                ///< index of the first voxel
    ivec3 size{0};              ///< voxels; zero: empty
    int componentCount = 1;     ///< 1 or 3
    bool isStaggered = false;   ///< component c sits half a voxel below the voxel along axis c
    bool isLevelSet = false;
    double background = 0;      ///< outside the box, of scalars
    dmat4 fileFromIndex{1};
    std::vector<float> values;  ///< x fastest, components side by side; finite
    std::vector<EmitterTriangle> surface;  ///< of a level set: where it is zero, file space
};

/// Where a grid lies in an effect, and what its values are multiplied by.
struct FieldPlacement {
    FieldSource source;
    dvec3 position{0};    ///< of the file's origin, m
    double scale = 1;     ///< of its lengths
    double strength = 1;  ///< of its values
    std::string where;    ///< file:line:column, for messages
};

struct Emitter {
    double rate = 0;  ///< particles per second
    std::vector<Burst> bursts;
    double delay = 0;             ///< s before it begins
    double duration = kInfinity;  ///< s from there; rate and bursts stop afterwards
    EmitterShape shape = EmitterShape::Point;
    dvec3 position{0};       ///< centre of the shape (line: start; cone: tip), effect space
    double radius = 0;       ///< sphere, disc, ring, cone (of its base)
    double innerRadius = 0;  ///< disc
    double height = 1;       ///< cone, > 0
    dvec3 normal{0, 1, 0};   ///< disc, ring; axis of a cone; unit
    dvec3 size{0};           ///< box, full edge lengths; line, from its start to its end
    bool fromSurface = false;  ///< sphere, box, cone: births on the surface, not in the volume
    std::shared_ptr<const std::vector<EmitterTriangle>> triangles;  ///< mesh; uniform over the area
    /// Volume: births in proportion to a density, or evenly on the surface of a level set; at
    /// `position`.
    std::optional<FieldPlacement> volume;
    std::optional<FieldPlacement> velocityField;  ///< added to the velocity at birth
    Path path;  ///< of the emitter, effect space
    double inherit = 0;        ///< share of the emitter's or parent's velocity that births take over
    dvec2 speed{0};            ///< m/s, [low, high]
    EmitterVelocity velocity = EmitterVelocity::Direction;
    dvec3 direction{0, 1, 0};  ///< unit
    double spread = 0;         ///< half angle of the cone of velocities, radians
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

/// Piecewise linear over normalised age in [0, 1], or over speed; keys sorted, at least one.
template <typename T>
struct Curve {
    std::vector<std::pair<double, T>> keys;
};

struct Effect;

enum class SubEmitterTrigger { Birth, Death, Collision, Way };

/// Particles of another effect that come from those of this one.
struct SubEmitter {
    SubEmitterTrigger trigger = SubEmitterTrigger::Death;
    dvec2 count{1};   ///< per event, [low, high]; fractions are probabilities
    double rate = 0;  ///< Way: per second along the way of each particle
    std::shared_ptr<const Effect> effect;  ///< its only emitter has no rate and no bursts
    std::string where;                     ///< file:line:column, for messages
};

enum class SurfaceType {
    Ribbon,    ///< the particles of one strand, in order of birth, as one thin surface
    Billboard  ///< each particle as a rectangle that faces the camera
};

/// Particles shown as thin surfaces instead of as media.
struct Surface {
    SurfaceType type = SurfaceType::Ribbon;
    std::string material;  ///< name of a thin material in the scene that uses the effect
    int columns = 1, rows = 1;    ///< billboard: frames in the material's texture, row by row
    Curve<double> frames;         ///< billboard, over life: number of the frame; no keys: all, once
    Curve<double> rotation{{{0, 0}}};  ///< billboard, over life: radians, counter-clockwise
    dvec2 startRotation{0};            ///< added, [low, high], radians
    dvec2 spin{0};                     ///< [low, high], radians per second
};

/// Fewer, larger particles far away.
struct Thinning {
    double distance = 0;  ///< m from the camera, where it begins; 0: never
    double least = 0.01;  ///< share of the particles that is always kept, (0, 1]
};

/// Where a soft sphere that scatters asks for the shadows on it.
enum class Shadowing {
    Particle,  ///< once, at its front towards the light: it does not shadow itself
    Sample     ///< at each place along the view ray
};

struct Effect {
    std::uint32_t capacity = 10000;
    std::uint32_t budget = 0;  ///< particles of all its instances in a scene together; 0: no limit
    std::uint32_t uncutCapacity = 0;  ///< before a budget lowered the capacity, to 0 maybe; 0: none has
    Thinning thinning;
    double tickRate = 120;  ///< simulation steps per second
    /// Particles stay behind when the instance moves, and modules act along the world's axes, from
    /// where the instance began; else all of it moves with the instance. Of a sub-emitter: as its
    /// parent, whatever it says.
    bool isWorldSpace = false;
    std::string medium;     ///< name in the scene that uses the effect; not used with a surface
    std::optional<Surface> surface;
    std::vector<Emitter> emitters;
    std::vector<ModuleSettings> modules;
    std::vector<SubEmitter> subEmitters;
    Curve<double> radius{{{0, 0.05}}};
    Curve<double> density{{{0, 1}}};
    Curve<dvec3> tint{{{0, dvec3(1)}}};  ///< multiplies albedo and emission of the medium
    Curve<double> temperature;           ///< K; with keys: the tint is multiplied by that of a black
                                         ///< body, relative to the luminance at 1500 K
    Curve<double> radiusBySpeed;         ///< m/s to a factor; no keys: 1
    Curve<double> densityBySpeed;
    bool smoothProfile = false;
    Shadowing shadowing = Shadowing::Particle;
    /// The grids that the effect names, once loaded (volumes::loadEffectFields).
    std::map<FieldSource, std::shared_ptr<const FieldValues>> fields;
};

}  // namespace brume::scene
