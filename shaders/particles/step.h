// SPDX-License-Identifier: Apache-2.0
// One tick of one particle: the step that the GPU and its twin on the CPU both compile.
// Equations: dv/dt = a - k (v - w) with a (gravity and fields) and w (wind) constant has the exact
// solution v(h) = w + (v - w) e^{-kh} + a phi1, x(h) = x + w h + (v - w) phi1 + a phi2 with phi1 =
// (1 - e^{-kh}) / k and phi2 = (h - phi1) / k. Fields are taken at the middle of the way, x + v h /
// 2: second order in h, and without drag the symplectic leapfrog. Source: exponential integrators,
// e.g. Hochbruck, Ostermann, Acta Numerica 19, 2010, 10.1017/S0962492910000048; leapfrog: Hairer,
// Lubich, Wanner, Acta Numerica 12, 2003, 10.1017/S0962492902000144. Limits: between hits of a
// collider the way is straight; what drag does between a hit and the end of its tick is that of the
// way without the hit.
#ifndef BRUME_SHADERS_PARTICLES_STEP_H
#define BRUME_SHADERS_PARTICLES_STEP_H

#include "effect.h"

BRUME_STRUCTS_BEGIN

BRUME_CONST uint kTinyBits = 0x1e3ce508u;  // of 1e-20
BRUME_CONST uint kHugeBits = 0x5d5e0b6bu;  // of 1e18
BRUME_CONST float kNotFinite = -2.0f;      // lifetime of what was killed for not being finite

/// Orders floats by magnitude, with infinity and NaN (of which compilers assume that it never is)
/// on top.
BRUME_SHARED uint magnitudeBits(float x) { return floatBitsToUint(x) & 0x7fffffffu; }

/// Sticks to a collider and does not move any more.
BRUME_SHARED bool isStuck(ParticleLife life) {
    return (floatBitsToUint(life.birthRemaining) & 0x80000000u) != 0u;
}

/// Part of the tick of its birth that was left, [0, 1].
BRUME_SHARED float partOfFirstTick(ParticleLife life) {
    return uintBitsToFloat(magnitudeBits(life.birthRemaining));
}

/// Age in ticks at the end of `tick`.
BRUME_SHARED float ageTicks(ParticleLife life, uint tick) {
    BRUME_PRECISE float age = float(tick - life.birthTick) + partOfFirstTick(life);
    return age;
}

BRUME_SHARED bool isAlive(ParticleLife life, uint tick) {
    return ageTicks(life, tick) < life.lifetimeTicks;
}

BRUME_SHARED vec3 withoutTiny(vec3 v) {
    return vec3(magnitudeBits(v.x) < kTinyBits ? 0.0f : v.x,
                magnitudeBits(v.y) < kTinyBits ? 0.0f : v.y,
                magnitudeBits(v.z) < kTinyBits ? 0.0f : v.z);
}

/// What surrounds a particle: what accelerates it and how the air moves there.
struct Surroundings {
    vec3 acceleration;  // m/s^2
    vec3 wind;          // m/s
};

/// A place as the modules see it.
BRUME_SHARED vec3 placeOfModules(BRUME_EFFECT_PARAMETER TickFields fields, vec3 position) {
    BRUME_PRECISE vec3 place = position;
    if (BRUME_IS_WORLD) place = place + fields.shift;
    return place;
}

/// One loop per type of module that depends on the place.
BRUME_SHARED Surroundings surroundingsAt(BRUME_EFFECT_PARAMETER BRUME_FIELDS_PARAMETER
                                             StepParameters parameters,
                                         TickFields fields, uint noiseSeed, vec3 position) {
    BRUME_PRECISE vec3 acceleration = parameters.acceleration;
    BRUME_PRECISE vec3 wind = parameters.wind;
    // The noise has its shift in its cells, where it loses nothing.
    vec3 place = placeOfModules(BRUME_EFFECT_ARGUMENT fields, position);
    for (uint i = 0u; i < BRUME_COUNT(curlNoise); ++i)
        acceleration = acceleration + curlNoiseAcceleration(BRUME_EFFECT.curlNoise[i],
                                                            fields.curlNoise[i], noiseSeed,
                                                            position);
    for (uint i = 0u; i < BRUME_COUNT(attractor); ++i)
        acceleration = acceleration + attractorAcceleration(BRUME_EFFECT.attractor[i], place);
    for (uint i = 0u; i < BRUME_COUNT(vortex); ++i)
        wind = wind + vortexVelocity(BRUME_EFFECT.vortex[i], place) *
                          BRUME_EFFECT.vortex[i].weight;
    for (uint i = 0u; i < BRUME_COUNT(velocityField); ++i)
        if (BRUME_EFFECT.velocityField[i].advects == 0u)
            wind = wind + velocityFieldAt(BRUME_FIELDS_ARGUMENT BRUME_EFFECT.velocityField[i],
                                          place) *
                              BRUME_EFFECT.velocityField[i].weight;
    for (uint i = 0u; i < BRUME_COUNT(buoyancy); ++i)
        acceleration = acceleration + buoyancyAcceleration(
                                          BRUME_FIELDS_ARGUMENT BRUME_EFFECT.buoyancy[i], place);
    Surroundings result;
    result.acceleration = acceleration;
    result.wind = wind;
    return result;
}

/// How fast the fields that advect carry a particle along, m/s.
BRUME_SHARED vec3 advectionAt(BRUME_EFFECT_PARAMETER BRUME_FIELDS_PARAMETER vec3 position) {
    BRUME_PRECISE vec3 velocity = vec3(0.0f);
    for (uint i = 0u; i < BRUME_COUNT(velocityField); ++i)
        if (BRUME_EFFECT.velocityField[i].advects != 0u)
            velocity = velocity + velocityFieldAt(BRUME_FIELDS_ARGUMENT
                                                      BRUME_EFFECT.velocityField[i],
                                                  position);
    return velocity;
}

/// Half a tick of all that drags by the square of the speed.
BRUME_SHARED vec3 dragQuadratically(BRUME_EFFECT_PARAMETER vec3 velocity, float seconds) {
    BRUME_PRECISE vec3 slowed = velocity;
    for (uint i = 0u; i < BRUME_COUNT(quadraticDrag); ++i)
        slowed = quadraticDragVelocity(BRUME_EFFECT.quadraticDrag[i], slowed, seconds);
    return slowed;
}

/// The exact solution under constant surroundings, with given factors over `seconds`.
BRUME_SHARED void integrate(BRUME_INOUT(vec3) position, BRUME_INOUT(vec3) velocity,
                            Surroundings around, float seconds, float loss, float velocityGain,
                            float positionGain) {
    BRUME_PRECISE vec3 slip = velocity - around.wind;
    BRUME_PRECISE vec3 x = position + (around.wind * seconds + slip * velocityGain +
                                       around.acceleration * positionGain);
    // The loss, not 1 - loss, multiplies: it keeps its digits over many short ticks.
    BRUME_PRECISE vec3 v = velocity + (around.acceleration * velocityGain - slip * loss);
    position = x;
    velocity = v;
}

/// The earliest hit of the straight way from start to end.
BRUME_SHARED Hit findHit(BRUME_EFFECT_PARAMETER BRUME_FIELDS_PARAMETER vec3 start, vec3 end) {
    Hit hit = noHit();
    for (uint i = 0u; i < BRUME_COUNT(planeCollider); ++i)
        sweepPlane(BRUME_EFFECT.planeCollider[i], start, end, hit);
    for (uint i = 0u; i < BRUME_COUNT(sphereCollider); ++i)
        sweepSphere(BRUME_EFFECT.sphereCollider[i], start, end, hit);
    for (uint i = 0u; i < BRUME_COUNT(boxCollider); ++i)
        sweepBox(BRUME_EFFECT.boxCollider[i], start, end, hit);
    for (uint i = 0u; i < BRUME_COUNT(capsuleCollider); ++i)
        sweepCapsule(BRUME_EFFECT.capsuleCollider[i], start, end, hit);
    for (uint i = 0u; i < BRUME_COUNT(levelSetCollider); ++i)
        sweepLevelSet(BRUME_FIELDS_ARGUMENT BRUME_EFFECT.levelSetCollider[i], start, end, hit);
    return hit;
}

/// What happened to a particle in a tick besides its motion.
struct StepOutcome {
    uint hasHit;         // 1: it hit a collider; the first hit counts
    float hitRemaining;  // part of the tick that was left then
    vec3 hitPosition;
    vec3 hitVelocity;  // after the hit
};

BRUME_CONST uint kMaxHitsPerTick = 4u;

/// Follows the way of a tick from (start, velocity before it) to `particle`, bounces included.
/// Between two hits the way is taken as straight; after the last that is followed, the particle
/// stays where it was hit, so that nothing is ever passed through.
BRUME_SHARED StepOutcome collide(BRUME_EFFECT_PARAMETER BRUME_FIELDS_PARAMETER
                                     StepParameters parameters,
                                 TickFields fields, vec3 start, vec3 startVelocity, float seconds,
                                 BRUME_INOUT(Particle) particle) {
    StepOutcome outcome;
    outcome.hasHit = 0u;
    outcome.hitRemaining = 0.0f;
    outcome.hitPosition = vec3(0.0f);
    outcome.hitVelocity = vec3(0.0f);
    // In locals: glslang does not end where `precise` values go through members of an inout struct
    // in a loop.
    BRUME_PRECISE vec3 from = placeOfModules(BRUME_EFFECT_ARGUMENT fields, start);
    BRUME_PRECISE vec3 to = placeOfModules(BRUME_EFFECT_ARGUMENT fields, particle.position);
    bool isStopped = false;
    BRUME_PRECISE vec3 before = startVelocity;
    BRUME_PRECISE vec3 after = particle.velocity;
    BRUME_PRECISE float left = 1.0f;  // part of `seconds`
    BRUME_PRECISE float ticks = seconds * parameters.ticksPerSecond;
    for (uint i = 0u; i < kMaxHitsPerTick; ++i) {
        Hit hit = findHit(BRUME_EFFECT_ARGUMENT BRUME_FIELDS_ARGUMENT from, to);
        if (hit.time > 1.0f) break;
        if (hit.response == kResponseWait) {
            to = hit.position;
            isStopped = true;
            break;
        }
        left = left - left * hit.time;
        BRUME_PRECISE vec3 met = before + (after - before) * hit.time;
        BRUME_PRECISE vec3 gain = after - met;  // what is still to come in this tick
        BRUME_PRECISE float speed = 0.0f - dotReplayable(met, hit.normal);
        BRUME_PRECISE float endSpeed = 0.0f - dotReplayable(after, hit.normal);
        bool bounces = speed > parameters.restSpeed;
        BRUME_PRECISE float push =
            bounces ? speed * hit.restitution + speed : (endSpeed > 0.0f ? endSpeed : 0.0f);
        BRUME_PRECISE vec3 base = bounces ? met : after;
        BRUME_PRECISE vec3 turned = rubVelocity(base + hit.normal * push, hit.normal, push,
                                                hit.friction);
        BRUME_PRECISE vec3 last = bounces ? turned + gain : turned;
        BRUME_PRECISE vec3 middle = (turned + last) * 0.5f;
        bool isLast = i + 1u == kMaxHitsPerTick || hit.response != kResponseBounce;
        BRUME_PRECISE vec3 end = hit.position + middle * (left * seconds);
        if (outcome.hasHit == 0u) {
            outcome.hasHit = 1u;
            BRUME_PRECISE float remaining = left * ticks;
            outcome.hitRemaining = remaining;
            outcome.hitPosition = hit.position;
            outcome.hitVelocity = turned;
        }
        to = isLast ? hit.position : end;
        after = hit.response == kResponseStick ? vec3(0.0f) : last;
        from = hit.position;
        before = turned;
        if (hit.response == kResponseKill) particle.life.lifetimeTicks = -1.0f;
        if (hit.response == kResponseStick)
            particle.life.birthRemaining =
                uintBitsToFloat(floatBitsToUint(particle.life.birthRemaining) | 0x80000000u);
        if (isLast) break;
    }
    if (BRUME_IS_WORLD) {
        BRUME_PRECISE vec3 back = to - fields.shift;
        // What has hit nothing keeps its digits.
        if (outcome.hasHit != 0u || isStopped) particle.position = back;
        BRUME_PRECISE vec3 hitPosition = outcome.hitPosition - fields.shift;
        outcome.hitPosition = hitPosition;
    } else {
        particle.position = to;
    }
    particle.velocity = after;
    return outcome;
}

/// Kills what has left the range of floats or is NaN: it is gone in the next tick.
BRUME_SHARED void killIfNotFinite(BRUME_INOUT(Particle) particle) {
    bool isFinite = magnitudeBits(particle.position.x) < kHugeBits &&
                    magnitudeBits(particle.position.y) < kHugeBits &&
                    magnitudeBits(particle.position.z) < kHugeBits &&
                    magnitudeBits(particle.velocity.x) < kHugeBits &&
                    magnitudeBits(particle.velocity.y) < kHugeBits &&
                    magnitudeBits(particle.velocity.z) < kHugeBits;
    if (!isFinite) {
        particle.position = vec3(0.0f);
        particle.velocity = vec3(0.0f);
        particle.life.lifetimeTicks = kNotFinite;
    }
}

/// `seconds` of a tick with the factors of the exact step over them.
BRUME_SHARED StepOutcome moveParticle(BRUME_EFFECT_PARAMETER BRUME_FIELDS_PARAMETER
                                          StepParameters parameters,
                                      TickFields fields, uint noiseSeed, float seconds, float loss,
                                      float velocityGain, float positionGain,
                                      BRUME_INOUT(Particle) particle) {
    BRUME_PRECISE float halfSeconds = 0.5f * seconds;
    vec3 start = particle.position;
    vec3 before = dragQuadratically(BRUME_EFFECT_ARGUMENT particle.velocity, halfSeconds);
    BRUME_PRECISE vec3 middle = start + before * halfSeconds;
    if (BRUME_COUNT(velocityField) > 0u)
        middle = middle +
                 advectionAt(BRUME_EFFECT_ARGUMENT BRUME_FIELDS_ARGUMENT placeOfModules(
                              BRUME_EFFECT_ARGUMENT fields, start)) *
                              halfSeconds;
    Surroundings around = surroundingsAt(BRUME_EFFECT_ARGUMENT BRUME_FIELDS_ARGUMENT parameters,
                                         fields, noiseSeed, middle);
    BRUME_PRECISE vec3 end = start;
    vec3 velocity = before;
    integrate(end, velocity, around, seconds, loss, velocityGain, positionGain);
    if (BRUME_COUNT(velocityField) > 0u)
        end = end + advectionAt(BRUME_EFFECT_ARGUMENT BRUME_FIELDS_ARGUMENT placeOfModules(
                        BRUME_EFFECT_ARGUMENT fields, middle)) *
                        seconds;
    velocity = dragQuadratically(BRUME_EFFECT_ARGUMENT velocity, halfSeconds);
    if (isStuck(particle.life)) {
        end = start;
        before = vec3(0.0f);
        velocity = vec3(0.0f);
    }
    particle.position = end;
    particle.velocity = velocity;
    StepOutcome outcome =
        collide(BRUME_EFFECT_ARGUMENT BRUME_FIELDS_ARGUMENT parameters, fields, start, before,
                seconds, particle);
    for (uint i = 0u; i < BRUME_COUNT(attractor); ++i)
        if (attractorSwallows(BRUME_EFFECT.attractor[i],
                              placeOfModules(BRUME_EFFECT_ARGUMENT fields, start),
                              placeOfModules(BRUME_EFFECT_ARGUMENT fields, particle.position)))
            particle.life.lifetimeTicks = -1.0f;
    // Devices differ in how they treat denormal numbers, so speeds end long before those.
    particle.velocity = withoutTiny(particle.velocity);
    killIfNotFinite(particle);
    return outcome;
}

/// A whole tick. `parameters` are those of the effect, loaded once for many particles.
BRUME_SHARED StepOutcome stepParticle(BRUME_EFFECT_PARAMETER BRUME_FIELDS_PARAMETER
                                          StepParameters parameters,
                                      TickFields fields, uint noiseSeed,
                                      BRUME_INOUT(Particle) particle) {
    return moveParticle(BRUME_EFFECT_ARGUMENT BRUME_FIELDS_ARGUMENT parameters, fields, noiseSeed,
                        parameters.tickSeconds, parameters.loss, parameters.velocityGain,
                        parameters.positionGain, particle);
}

/// The parameters of a step over a part of a tick, as after a birth within it.
BRUME_SHARED StepParameters partOfStep(StepParameters parameters, float part) {
    BRUME_PRECISE float seconds = parameters.tickSeconds * part;
    BRUME_PRECISE float loss, phi1, phi2;
    BRUME_PRECISE float drag = parameters.dragPerTick * part;
    exponentialFactors(drag, parameters.dragHalvings, loss, phi1, phi2);
    BRUME_PRECISE float velocityGain = seconds * phi1;
    BRUME_PRECISE float positionGain = seconds * seconds * phi2;
    parameters.tickSeconds = seconds;
    parameters.loss = loss;
    parameters.velocityGain = velocityGain;
    parameters.positionGain = positionGain;
    return parameters;
}

/// A part of a tick.
BRUME_SHARED StepOutcome stepParticlePart(BRUME_EFFECT_PARAMETER BRUME_FIELDS_PARAMETER
                                              StepParameters parameters,
                                          TickFields fields, uint noiseSeed, float part,
                                          BRUME_INOUT(Particle) particle) {
    return stepParticle(BRUME_EFFECT_ARGUMENT BRUME_FIELDS_ARGUMENT partOfStep(parameters, part),
                        fields, noiseSeed, particle);
}

BRUME_STRUCTS_END
#endif
