// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <shaders/particles/spawn.h>
#include <core/error.hpp>
#include <particles/compiled_emitter.hpp>
#include <particles/modules/module.hpp>

#include <algorithm>
#include <cmath>

namespace brume::particles {
namespace {

void makeFrames(const scene::Emitter& emitter, shader::EmitterParameters& p) {
    dvec3 tangent, bitangent;
    // Only these shapes have an axis of their own; others follow the direction.
    const bool hasAxis = emitter.shape == scene::EmitterShape::Disc ||
                         emitter.shape == scene::EmitterShape::Ring ||
                         emitter.shape == scene::EmitterShape::Cone;
    const dvec3 direction = glm::normalize(emitter.direction);
    const dvec3 axis = hasAxis ? glm::normalize(emitter.normal) : direction;
    makeFrame(axis, tangent, bitangent);
    p.axis = vec3(axis);
    p.tangent = vec3(tangent);
    p.bitangent = vec3(bitangent);
    makeFrame(direction, tangent, bitangent);
    p.direction = vec3(direction);
    p.directionTangent = vec3(tangent);
    p.directionBitangent = vec3(bitangent);
}

/// What a share of [0, 1) is as a word of 32 bits.
std::uint32_t rankOf(double share) {
    return static_cast<std::uint32_t>(std::min(std::floor(share * 4294967296.0), 4294967295.0));
}

/// The triangles of a mesh with their shares of its area, at the end of `all`; those without area
/// are left out.
void addTriangles(const std::vector<scene::EmitterTriangle>& triangles,
                  std::vector<shader::EmitterTriangle>& all, shader::EmitterParameters& p) {
    p.firstTriangle = static_cast<std::uint32_t>(all.size());
    double area = 0;
    for (const scene::EmitterTriangle& t : triangles)
        area += glm::length(glm::cross(t.b - t.a, t.c - t.a));
    double before = 0;
    for (const scene::EmitterTriangle& t : triangles) {
        const dvec3 normal = glm::cross(t.b - t.a, t.c - t.a);
        const double size = glm::length(normal);
        if (!(size > 1e-12 * area)) continue;
        all.push_back({vec3(t.a), vec3(t.b - t.a), vec3(t.c - t.a), vec3(normal / size),
                       rankOf(before / area)});
        before += size;
    }
    p.triangleCount = static_cast<std::uint32_t>(all.size()) - p.firstTriangle;
    if (p.triangleCount == 0)
        throw inputError("setting up an effect", "",
                         "the mesh of an emitter has no area, triangles with area allowed");
}

/// The voxels of a density with their shares of its sum, at the end of `all`.
void addVoxels(const scene::FieldPlacement& placement, const scene::FieldValues& field,
               std::vector<shader::EmitterTriangle>& all, shader::EmitterParameters& p) {
    p.firstTriangle = static_cast<std::uint32_t>(all.size());
    const dmat4 place = effectFromIndex(placement, field);
    double sum = 0;
    for (const float value : field.values) sum += std::max(value, 0.0f);
    double before = 0;
    std::size_t i = 0;
    for (int z = 0; z < field.size.z; ++z)
        for (int y = 0; y < field.size.y; ++y)
            for (int x = 0; x < field.size.x; ++x, ++i) {
                const double value = field.values[i];
                if (!(value > 1e-12 * sum)) continue;
                const dvec3 corner = transformPoint(place, dvec3(field.lo + ivec3(x, y, z)));
                all.push_back({vec3(corner), vec3(dvec3(place[0])), vec3(dvec3(place[1])),
                               vec3(dvec3(place[2])), rankOf(before / sum)});
                before += value;
            }
    p.triangleCount = static_cast<std::uint32_t>(all.size()) - p.firstTriangle;
    if (p.triangleCount == 0)
        throw inputError("setting up an effect", placement.where,
                         "the grid has no positive values, a density allowed");
}

/// Births in a density, or on the surface of a level set.
void addVolumeShape(const scene::Effect& effect, const scene::FieldPlacement& placement,
                    std::vector<shader::EmitterTriangle>& all, shader::EmitterParameters& p) {
    const scene::FieldValues& field = findField(effect, placement, 1);
    if (!field.isLevelSet) {
        addVoxels(placement, field, all, p);
        return;
    }
    p.shape = shader::kShapeMesh;
    const dmat4 place = effectFromFile(placement);
    std::vector<scene::EmitterTriangle> triangles = field.surface;
    for (scene::EmitterTriangle& t : triangles)
        t = {transformPoint(place, t.a), transformPoint(place, t.b), transformPoint(place, t.c)};
    addTriangles(triangles, all, p);
}

shader::EmitterParameters emitterParameters(const scene::Emitter& emitter, double tickRate) {
    const double halfSpread = std::sin(0.5 * std::min(emitter.spread, kPi));
    shader::EmitterParameters p{};
    makeFrames(emitter, p);
    p.position = vec3(emitter.position);
    p.shape = static_cast<std::uint32_t>(emitter.shape);
    p.size = vec3(emitter.size);
    p.radius = static_cast<float>(emitter.radius);
    p.height = static_cast<float>(emitter.height);
    if (emitter.radius > 0)
        p.innerRadius2 = static_cast<float>(std::pow(emitter.innerRadius / emitter.radius, 2));
    p.isSurface = emitter.fromSurface;
    p.birthField = shader::kNoField;
    p.velocityMode = static_cast<std::uint32_t>(emitter.velocity);
    p.coneHeight = static_cast<float>(2 * halfSpread * halfSpread);  // 1 - cos(spread)
    p.speedLow = static_cast<float>(emitter.speed.x);
    p.speedRange = static_cast<float>(emitter.speed.y - emitter.speed.x);
    p.lifetimeLowTicks = static_cast<float>(emitter.lifetime.x * tickRate);
    p.lifetimeRangeTicks = static_cast<float>((emitter.lifetime.y - emitter.lifetime.x) * tickRate);
    p.inheritPerTick = static_cast<float>(emitter.inherit * tickRate);
    p.inheritSpeed = static_cast<float>(emitter.inherit);
    const dvec3 s = emitter.size;
    const dvec3 faces(s.y * s.z, s.z * s.x, s.x * s.y);
    const double area = faces.x + faces.y + faces.z;
    p.faceX = area > 0 ? static_cast<float>(faces.x / area) : 1.0f / 3;
    p.faceXY = area > 0 ? static_cast<float>((faces.x + faces.y) / area) : 2.0f / 3;
    return p;
}

/// The grid that a moving emitter's births take their velocity from.
void addBirthField(const scene::Effect& effect, const scene::FieldPlacement& placement,
                   FieldPacker& packer, shader::EffectParameters& p,
                   shader::EmitterParameters& emitter) {
    if (p.birthFieldCount == shader::kMaxModulesPerType)
        throw inputError("setting up an effect", placement.where,
                         fmt::format("one 'velocityField' too many, at most {} allowed",
                                     shader::kMaxModulesPerType));
    emitter.birthField = p.birthFieldCount;
    shader::VelocityField& field = p.birthField[p.birthFieldCount++];
    field.grid = packer.add(placement, findField(effect, placement, 3), 0);
    field.strength = static_cast<float>(placement.strength);
}

}  // namespace

void addEmitter(const scene::Effect& effect, const scene::Emitter& emitter, FieldPacker& packer,
                CompiledEffect& compiled) {
    compiled.emitters.push_back(emitterParameters(emitter, effect.tickRate));
    shader::EmitterParameters& last = compiled.emitters.back();
    if (emitter.shape == scene::EmitterShape::Mesh)
        addTriangles(*emitter.triangles, compiled.triangles, last);
    if (emitter.shape == scene::EmitterShape::Volume)
        addVolumeShape(effect, *emitter.volume, compiled.triangles, last);
    if (emitter.velocityField)
        addBirthField(effect, *emitter.velocityField, packer, compiled.parameters, last);
}

}  // namespace brume::particles
