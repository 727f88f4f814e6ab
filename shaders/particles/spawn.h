// SPDX-License-Identifier: Apache-2.0
// The birth of a particle, as a pure function of its emitter and birth index.
#ifndef BRUME_SHADERS_PARTICLES_SPAWN_H
#define BRUME_SHADERS_PARTICLES_SPAWN_H

#include "effect.h"

BRUME_STRUCTS_BEGIN

BRUME_CONST uint kShapePoint = 0u;
BRUME_CONST uint kShapeLine = 1u;
BRUME_CONST uint kShapeDisc = 2u;
BRUME_CONST uint kShapeRing = 3u;
BRUME_CONST uint kShapeSphere = 4u;
BRUME_CONST uint kShapeBox = 5u;
BRUME_CONST uint kShapeCone = 6u;
BRUME_CONST uint kShapeMesh = 7u;
BRUME_CONST uint kShapeVolume = 8u;  // "triangles" are voxels: place, axes as edges and normal

BRUME_CONST uint kVelocityDirection = 0u;  // around EmitterParameters::direction
BRUME_CONST uint kVelocityRadial = 1u;     // around the way from the emitter's place
BRUME_CONST uint kVelocityNormal = 2u;     // around the normal of the shape

/// Where a particle is born, and the shape's normal there.
struct ShapeSample {
    vec3 offset;  // from the emitter's place
    vec3 normal;  // unit
};

/// Uniform direction in the cone around axis whose height on the unit sphere is coneHeight = 1 -
/// cos(spread).
BRUME_SHARED vec3 sampleCone(vec3 axis, vec3 tangent, vec3 bitangent, float coneHeight, float u,
                             float turns) {
    // With h = 1 - cos, sin^2 = h (2 - h) keeps its digits in narrow cones.
    BRUME_PRECISE float height = coneHeight * u;
    BRUME_PRECISE float radius = sqrtReplayable(height * (2.0f - height));
    BRUME_PRECISE float cosine, sine;
    cosSinTurns(turns, cosine, sine);
    BRUME_PRECISE vec3 direction =
        axis * (1.0f - height) + tangent * (radius * cosine) + bitangent * (radius * sine);
    return direction;
}

/// A fifth random number from the bits that unitFloat() leaves of three words.
BRUME_SHARED float spareUnitFloat(uvec4 w) {
    return unitFloat(((w.x & 0xffu) << 24u) | ((w.y & 0xffu) << 16u) | ((w.z & 0xffu) << 8u));
}

BRUME_SHARED float largerOf(float a, float b) { return a > b ? a : b; }

/// Uniform over the volume, or over the faces: the pair of faces by its share of the area, the side
/// by a bit.
BRUME_SHARED ShapeSample sampleBox(EmitterParameters emitter, uvec4 w) {
    BRUME_PRECISE float u = unitFloat(w.x) - 0.5f;
    BRUME_PRECISE float v = unitFloat(w.y) - 0.5f;
    BRUME_PRECISE float s = unitFloat(w.z) - 0.5f;
    BRUME_PRECISE float choice = unitFloat(w.w);
    float side = (w.x & 1u) != 0u ? 0.5f : -0.5f;
    bool isX = choice < emitter.faceX;
    bool isY = !isX && choice < emitter.faceXY;
    bool isFace = emitter.isSurface != 0u;
    BRUME_PRECISE vec3 unit = vec3(isFace && isX ? side : u, isFace && isY ? side : v,
                                   isFace && !isX && !isY ? side : s);
    ShapeSample result;
    BRUME_PRECISE vec3 offset = emitter.size * unit;
    BRUME_PRECISE float twice = side + side;
    result.offset = offset;
    result.normal = isFace ? vec3(isX ? twice : 0.0f, isY ? twice : 0.0f,
                                  !isX && !isY ? twice : 0.0f)
                           : emitter.axis;
    return result;
}

/// Disc by area between its radii; ring.
BRUME_SHARED ShapeSample sampleRound(EmitterParameters emitter, uvec4 w) {
    BRUME_PRECISE float share =
        emitter.innerRadius2 + (1.0f - emitter.innerRadius2) * unitFloat(w.x);
    bool isRing = emitter.shape == kShapeRing;
    BRUME_PRECISE float radius = isRing ? emitter.radius : emitter.radius * sqrtReplayable(share);
    BRUME_PRECISE float cosine, sine;
    cosSinTurns(unitFloat(w.y), cosine, sine);
    BRUME_PRECISE vec3 outward = emitter.tangent * cosine + emitter.bitangent * sine;
    ShapeSample result;
    BRUME_PRECISE vec3 offset = outward * radius;
    result.offset = offset;
    result.normal = isRing ? outward : emitter.axis;
    return result;
}

BRUME_SHARED ShapeSample sampleSphere(EmitterParameters emitter, uvec4 w) {
    // The radius of a uniform point is distributed as the largest of three uniform numbers.
    BRUME_PRECISE float share =
        largerOf(largerOf(unitFloat(w.z), unitFloat(w.w)), spareUnitFloat(w));
    share = emitter.isSurface != 0u ? 1.0f : share;
    BRUME_PRECISE vec3 direction = sampleCone(emitter.axis, emitter.tangent, emitter.bitangent,
                                              2.0f, unitFloat(w.x), unitFloat(w.y));
    ShapeSample result;
    BRUME_PRECISE vec3 offset = direction * (emitter.radius * share);
    result.offset = offset;
    result.normal = direction;
    return result;
}

/// Cone with its tip at the emitter's place: its volume, or its mantle without the base.
BRUME_SHARED ShapeSample sampleConeShape(EmitterParameters emitter, uvec4 w) {
    bool isMantle = emitter.isSurface != 0u;
    // Part of the height: the largest of three uniform numbers in the volume, of two on the mantle.
    BRUME_PRECISE float part = largerOf(unitFloat(w.z), unitFloat(w.w));
    part = isMantle ? part : largerOf(part, spareUnitFloat(w));
    BRUME_PRECISE float radius =
        emitter.radius * part * (isMantle ? 1.0f : sqrtReplayable(unitFloat(w.x)));
    BRUME_PRECISE float cosine, sine;
    cosSinTurns(unitFloat(w.y), cosine, sine);
    BRUME_PRECISE vec3 outward = emitter.tangent * cosine + emitter.bitangent * sine;
    ShapeSample result;
    BRUME_PRECISE vec3 offset = emitter.axis * (emitter.height * part) + outward * radius;
    BRUME_PRECISE vec3 steep = outward * emitter.height - emitter.axis * emitter.radius;
    result.offset = offset;
    result.normal = directionReplayable(steep, emitter.axis);
    return result;
}

/// Uniform over a triangle.
BRUME_SHARED ShapeSample sampleTriangle(EmitterTriangle triangle, uvec4 w) {
    BRUME_PRECISE float u = unitFloat(w.y);
    BRUME_PRECISE float v = unitFloat(w.z);
    // The parallelogram's other half is folded back.
    bool isBeyond = u + v > 1.0f;
    u = isBeyond ? 1.0f - u : u;
    v = isBeyond ? 1.0f - v : v;
    ShapeSample result;
    BRUME_PRECISE vec3 offset = triangle.corner + triangle.edge1 * u + triangle.edge2 * v;
    result.offset = offset;
    result.normal = triangle.normal;
    return result;
}

/// 16 random bits as a number in [0, 1).
BRUME_SHARED float unitFloat16(uint bits) {
    BRUME_PRECISE float u = float(bits & 0xffffu) * 1.52587890625e-5f;
    return u;
}

/// In proportion to the trilinear density around a voxel: the difference of two uniform numbers has
/// the hat function of the interpolation as its density.
BRUME_SHARED ShapeSample sampleVoxel(EmitterTriangle voxel, vec3 axis, uvec4 w) {
    BRUME_PRECISE float u = unitFloat16(w.y) - unitFloat16(w.y >> 16u);
    BRUME_PRECISE float v = unitFloat16(w.z) - unitFloat16(w.z >> 16u);
    BRUME_PRECISE float s = unitFloat16(w.w) - unitFloat16(w.w >> 16u);
    ShapeSample result;
    BRUME_PRECISE vec3 offset =
        voxel.corner + voxel.edge1 * u + voxel.edge2 * v + voxel.normal * s;
    result.offset = offset;
    result.normal = axis;
    return result;
}

/// The triangle whose share of the area contains the random word: the last with rank <= word.
/// BRUME_TRIANGLES is an array in C++ and a buffer in GLSL.
BRUME_SHARED uint findTriangle(BRUME_TRIANGLES_PARAMETER EmitterParameters emitter, uint word) {
    uint low = 0u;
    uint high = emitter.triangleCount;
    for (uint step = 0u; step < 32u && high > low + 1u; ++step) {
        uint middle = low + (high - low) / 2u;
        bool isBelow = BRUME_TRIANGLES[emitter.firstTriangle + middle].rank <= word;
        low = isBelow ? middle : low;
        high = isBelow ? high : middle;
    }
    return emitter.firstTriangle + low;
}

/// Uniform over the emitter's shape; w are four random words.
BRUME_SHARED ShapeSample sampleShape(BRUME_TRIANGLES_PARAMETER EmitterParameters emitter,
                                     uvec4 w) {
    ShapeSample result;
    result.offset = vec3(0.0f);
    result.normal = emitter.axis;
    if (emitter.shape == kShapeLine) {
        BRUME_PRECISE vec3 offset = emitter.size * unitFloat(w.x);
        result.offset = offset;
    } else if (emitter.shape == kShapeBox) {
        result = sampleBox(emitter, w);
    } else if (emitter.shape == kShapeDisc || emitter.shape == kShapeRing) {
        result = sampleRound(emitter, w);
    } else if (emitter.shape == kShapeSphere) {
        result = sampleSphere(emitter, w);
    } else if (emitter.shape == kShapeCone) {
        result = sampleConeShape(emitter, w);
    } else if (emitter.shape == kShapeMesh) {
        result = sampleTriangle(
            BRUME_TRIANGLES[findTriangle(BRUME_TRIANGLES_ARGUMENT emitter, w.x)], w);
    } else if (emitter.shape == kShapeVolume) {
        result = sampleVoxel(BRUME_TRIANGLES[findTriangle(BRUME_TRIANGLES_ARGUMENT emitter, w.x)],
                             emitter.axis, w);
    }
    return result;
}

/// Lifetime alone: decides whether a particle outlives its first tick. `remaining`: part of the
/// tick that is left.
BRUME_SHARED ParticleLife spawnLife(RandomStream random, EmitterParameters emitter,
                                    uint birthIndex, float remaining, uint tick) {
    uvec4 motion = randomWords(random, birthIndex, kChannelMotion);
    BRUME_PRECISE float lifetime =
        emitter.lifetimeLowTicks + emitter.lifetimeRangeTicks * unitFloat(motion.x);
    ParticleLife life;
    life.birthTick = tick;
    life.birthRemaining = remaining > 0.0f ? remaining : 0.0f;
    life.lifetimeTicks = lifetime;
    return life;
}

/// Part of its first tick that is left to a birth of a batch.
BRUME_SHARED float remainingOf(BirthBatch batch, uint indexInBatch) {
    BRUME_PRECISE float remaining = batch.remaining - float(indexInBatch) * batch.remainingStep;
    return remaining > 0.0f ? remaining : 0.0f;
}

/// A particle at the moment of its birth, with the emitter displaced by `offset` and moving at
/// `velocity`, of which the particle takes over what its emitter says.
BRUME_SHARED Particle spawnParticle(BRUME_EFFECT_PARAMETER BRUME_FIELDS_PARAMETER
                                        BRUME_TRIANGLES_PARAMETER RandomStream random,
                                    EmitterParameters emitter, uint birthIndex, float remaining,
                                    uint tick, vec3 offset, vec3 velocity) {
    Particle particle;
    particle.birthIndex = birthIndex;
    particle.life = spawnLife(random, emitter, birthIndex, remaining, tick);
    uvec4 motion = randomWords(random, birthIndex, kChannelMotion);
    ShapeSample place = sampleShape(BRUME_TRIANGLES_ARGUMENT emitter,
                                    randomWords(random, birthIndex, kChannelShape));
    BRUME_PRECISE vec3 position = emitter.position + offset + place.offset;
    particle.position = position;

    vec3 axis = emitter.direction;
    vec3 tangent = emitter.directionTangent;
    vec3 bitangent = emitter.directionBitangent;
    if (emitter.velocityMode != kVelocityDirection) {
        axis = emitter.velocityMode == kVelocityRadial
                   ? directionReplayable(place.offset, emitter.direction)
                   : place.normal;
        frameReplayable(axis, tangent, bitangent);
    }
    BRUME_PRECISE float speed = emitter.speedLow + emitter.speedRange * unitFloat(motion.y);
    BRUME_PRECISE vec3 start = sampleCone(axis, tangent, bitangent, emitter.coneHeight,
                                          unitFloat(motion.z), unitFloat(motion.w)) *
                                   speed +
                               velocity;
    for (uint i = 0u; i < BRUME_COUNT(birthField); ++i)
        if (i == emitter.birthField)
            start = start + velocityFieldAt(BRUME_FIELDS_ARGUMENT BRUME_EFFECT.birthField[i],
                                            position);
    particle.velocity = start;
    return particle;
}

/// A birth of effect space in the world's: turned with the instance, at `offset`, and as fast as
/// `velocity` more.
BRUME_SHARED void placeInWorld(InstanceParameters instance, vec3 offset, vec3 velocity,
                               BRUME_INOUT(Particle) particle) {
    vec3 p = particle.position;
    vec3 v = particle.velocity;
    BRUME_PRECISE vec3 position =
        instance.axisX * p.x + instance.axisY * p.y + instance.axisZ * p.z + offset;
    BRUME_PRECISE vec3 start =
        instance.axisX * v.x + instance.axisY * v.y + instance.axisZ * v.z + velocity;
    particle.position = position;
    particle.velocity = start;
}

/// A birth of a batch: the emitter moves straight in a tick.
BRUME_SHARED Particle spawnFromBatch(BRUME_EFFECT_PARAMETER BRUME_FIELDS_PARAMETER
                                         BRUME_TRIANGLES_PARAMETER InstanceParameters instance,
                                     EmitterParameters emitter, BirthBatch batch,
                                     uint indexInBatch, uint tick) {
    BRUME_PRECISE float remaining = remainingOf(batch, indexInBatch);
    BRUME_PRECISE vec3 offset = batch.offset - batch.motion * remaining;
    BRUME_PRECISE vec3 velocity =
        batch.motion * emitter.inheritPerTick + batch.velocity * emitter.inheritSpeed;
    bool isWorld = BRUME_IS_WORLD;
    Particle particle = spawnParticle(
        BRUME_EFFECT_ARGUMENT BRUME_FIELDS_ARGUMENT BRUME_TRIANGLES_ARGUMENT instance.random,
        emitter, batch.firstBirthIndex + indexInBatch, remaining, tick,
        isWorld ? vec3(0.0f) : offset, isWorld ? vec3(0.0f) : velocity);
    if (isWorld) placeInWorld(instance, offset, velocity, particle);
    return particle;
}

BRUME_STRUCTS_END
#endif
