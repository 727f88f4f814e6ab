// SPDX-License-Identifier: Apache-2.0
// The birth of a particle, as a pure function of its emitter and birth index.
#ifndef BRUME_SHADERS_PARTICLES_SPAWN_H
#define BRUME_SHADERS_PARTICLES_SPAWN_H

#include "effect.h"

BRUME_STRUCTS_BEGIN

BRUME_CONST uint kShapePoint = 0u;
BRUME_CONST uint kShapeSphere = 1u;
BRUME_CONST uint kShapeBox = 2u;
BRUME_CONST uint kShapeDisc = 3u;

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

/// Uniform over the volume (box, sphere) or area (disc) of the emitter's shape; w are four random
/// words.
BRUME_SHARED vec3 sampleShape(EmitterParameters emitter, uvec4 w) {
    BRUME_PRECISE float u = unitFloat(w.x);
    BRUME_PRECISE float v = unitFloat(w.y);
    BRUME_PRECISE float s = unitFloat(w.z);
    BRUME_PRECISE vec3 offset = vec3(0.0f);
    if (emitter.shape == kShapeBox) {
        offset = emitter.size * vec3(u - 0.5f, v - 0.5f, s - 0.5f);
    } else if (emitter.shape == kShapeDisc) {
        BRUME_PRECISE float radius = emitter.radius * sqrtReplayable(u);
        BRUME_PRECISE float cosine, sine;
        cosSinTurns(v, cosine, sine);
        offset = emitter.tangent * (radius * cosine) + emitter.bitangent * (radius * sine);
    } else if (emitter.shape == kShapeSphere) {
        // The radius of a uniform point is distributed as the largest of three uniform numbers.
        BRUME_PRECISE float t = unitFloat(w.w);
        uint low = ((w.x & 0xffu) << 16u) | ((w.y & 0xffu) << 8u) | (w.z & 0xffu);
        BRUME_PRECISE float r = unitFloat(low << 8u);
        r = r > s ? r : s;
        r = r > t ? r : t;
        BRUME_PRECISE vec3 direction =
            sampleCone(emitter.axis, emitter.tangent, emitter.bitangent, 2.0f, u, v);
        offset = direction * (emitter.radius * r);
    }
    BRUME_PRECISE vec3 position = emitter.position + offset;
    return position;
}

/// Lifetime alone: decides whether a particle outlives its first tick.
BRUME_SHARED ParticleLife spawnLife(RandomStream random, EmitterParameters emitter,
                                    BirthBatch batch, uint indexInBatch, uint tick) {
    uvec4 motion = randomWords(random, batch.firstBirthIndex + indexInBatch, kChannelMotion);
    BRUME_PRECISE float remaining = batch.remaining - float(indexInBatch) * batch.remainingStep;
    BRUME_PRECISE float lifetime =
        emitter.lifetimeLowTicks + emitter.lifetimeRangeTicks * unitFloat(motion.x);
    ParticleLife life;
    life.birthTick = tick;
    life.birthRemaining = remaining > 0.0f ? remaining : 0.0f;
    life.lifetimeTicks = lifetime;
    return life;
}

/// A particle at the moment of its birth.
BRUME_SHARED Particle spawnParticle(RandomStream random, EmitterParameters emitter,
                                    BirthBatch batch, uint indexInBatch, uint tick) {
    Particle particle;
    particle.birthIndex = batch.firstBirthIndex + indexInBatch;
    particle.life = spawnLife(random, emitter, batch, indexInBatch, tick);
    uvec4 motion = randomWords(random, particle.birthIndex, kChannelMotion);
    particle.position =
        sampleShape(emitter, randomWords(random, particle.birthIndex, kChannelShape));
    BRUME_PRECISE float speed = emitter.speedLow + emitter.speedRange * unitFloat(motion.y);
    BRUME_PRECISE vec3 velocity =
        sampleCone(emitter.axis, emitter.tangent, emitter.bitangent, emitter.coneHeight,
                   unitFloat(motion.z), unitFloat(motion.w)) *
        speed;
    particle.velocity = velocity;
    return particle;
}

BRUME_STRUCTS_END
#endif
