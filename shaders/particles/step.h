// SPDX-License-Identifier: Apache-2.0
// One tick of one particle: the step that the GPU and its twin on the CPU both compile.
// Equations: dv/dt = a - k (v - w) with a (gravity and fields at the start of the step) and w
// (wind) constant has the exact solution v(h) = w + (v - w) e^{-kh} + a phi1, x(h) = x + w h + (v -
// w) phi1 + a phi2 with phi1 = (1 - e^{-kh}) / k and phi2 = (h - phi1) / k. Source: exponential
// Euler, e.g. Hochbruck, Ostermann, "Exponential integrators", Acta Numerica 19,
// 2010, 10.1017/S0962492910000048.
#ifndef BRUME_SHADERS_PARTICLES_STEP_H
#define BRUME_SHADERS_PARTICLES_STEP_H

#include "effect.h"

BRUME_STRUCTS_BEGIN

BRUME_CONST uint kTinyBits = 0x1e3ce508u;  // of 1e-20
BRUME_CONST uint kHugeBits = 0x5d5e0b6bu;  // of 1e18

/// Orders floats by magnitude, with infinity and NaN (of which compilers assume that it never is)
/// on top.
BRUME_SHARED uint magnitudeBits(float x) { return floatBitsToUint(x) & 0x7fffffffu; }

/// Age in ticks at the end of `tick`.
BRUME_SHARED float ageTicks(ParticleLife life, uint tick) {
    BRUME_PRECISE float age = float(tick - life.birthTick) + life.birthRemaining;
    return age;
}

BRUME_SHARED bool isAlive(ParticleLife life, uint tick) {
    return ageTicks(life, tick) < life.lifetimeTicks;
}

/// Accelerations that depend on the place: one loop per type of field module.
BRUME_SHARED vec3 fieldAcceleration(BRUME_EFFECT_PARAMETER vec3 position) {
    BRUME_PRECISE vec3 sum = vec3(0.0f);
    for (uint i = 0u; i < BRUME_CURL_NOISE_COUNT; ++i)
        sum = sum + curlNoiseAcceleration(BRUME_EFFECT.curlNoise[i], position);
    return sum;
}

/// The step with given factors over `seconds`.
BRUME_SHARED void integrate(BRUME_INOUT(vec3) position, BRUME_INOUT(vec3) velocity,
                            vec3 acceleration, vec3 wind, float seconds, float loss,
                            float velocityGain, float positionGain) {
    BRUME_PRECISE vec3 slip = velocity - wind;
    BRUME_PRECISE vec3 x =
        position + (wind * seconds + slip * velocityGain + acceleration * positionGain);
    // The loss, not 1 - loss, multiplies: it keeps its digits over many short ticks.
    BRUME_PRECISE vec3 v = velocity + (acceleration * velocityGain - slip * loss);
    position = x;
    // Devices differ in how they treat denormal numbers, so speeds end long before those.
    velocity = vec3(magnitudeBits(v.x) < kTinyBits ? 0.0f : v.x,
                    magnitudeBits(v.y) < kTinyBits ? 0.0f : v.y,
                    magnitudeBits(v.z) < kTinyBits ? 0.0f : v.z);
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
        particle.life.lifetimeTicks = -1.0f;
    }
}

/// A whole tick. `parameters` are those of the effect, loaded once for many particles.
BRUME_SHARED void stepParticle(BRUME_EFFECT_PARAMETER StepParameters parameters,
                               BRUME_INOUT(Particle) particle) {
    BRUME_PRECISE vec3 acceleration =
        parameters.acceleration + fieldAcceleration(BRUME_EFFECT_ARGUMENT particle.position);
    integrate(particle.position, particle.velocity, acceleration, parameters.wind,
              parameters.tickSeconds, parameters.loss, parameters.velocityGain,
              parameters.positionGain);
    killIfNotFinite(particle);
}

/// The part of its first tick that is left after a particle's birth.
BRUME_SHARED void stepNewParticle(BRUME_EFFECT_PARAMETER StepParameters parameters,
                                  BRUME_INOUT(Particle) particle) {
    BRUME_PRECISE float part = particle.life.birthRemaining;
    BRUME_PRECISE float seconds = parameters.tickSeconds * part;
    BRUME_PRECISE float loss, phi1, phi2;
    BRUME_PRECISE float drag = parameters.dragPerTick * part;
    exponentialFactors(drag, parameters.dragHalvings, loss, phi1, phi2);
    BRUME_PRECISE float velocityGain = seconds * phi1;
    BRUME_PRECISE float positionGain = seconds * seconds * phi2;
    BRUME_PRECISE vec3 acceleration =
        parameters.acceleration + fieldAcceleration(BRUME_EFFECT_ARGUMENT particle.position);
    integrate(particle.position, particle.velocity, acceleration, parameters.wind, seconds, loss,
              velocityGain, positionGain);
    killIfNotFinite(particle);
}

BRUME_STRUCTS_END
#endif
