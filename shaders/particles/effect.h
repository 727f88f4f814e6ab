// SPDX-License-Identifier: Apache-2.0
// The structs of the particle simulator that C++ and GLSL share (scalar block layout): the state of
// a particle and the parameters of an effect. An effect's time runs in integer ticks; tick k covers
// the time from k to k + 1 ticks.
#ifndef BRUME_SHADERS_PARTICLES_EFFECT_H
#define BRUME_SHADERS_PARTICLES_EFFECT_H

#include "../common/random.h"
#include "../common/shared_math.h"
#include "modules/curl_noise.h"

BRUME_STRUCTS_BEGIN

BRUME_CONST uint kMaxFieldsPerType = 4u;    // e.g. curl_noise modules in one effect
BRUME_CONST uint kMaxAppearanceKeys = 64u;  // over-life keys at different ages

// Random channels of a birth; each gives four words.
BRUME_CONST uint kChannelMotion = 0u;  // lifetime, speed, two for the direction
BRUME_CONST uint kChannelShape = 1u;   // the place in the shape

/// When a particle was born and for how long; all that decides its death by age.
struct ParticleLife {
    uint birthTick;        // the tick in which it was born
    float birthRemaining;  // part of that tick that was left at birth, [0, 1]
    float lifetimeTicks;   // negative: killed
};

/// The hot state, 40 bytes; on the GPU one array per field. Metres and m/s in effect space.
struct Particle {
    vec3 position;
    vec3 velocity;
    ParticleLife life;
    uint birthIndex;  // counts every birth of the effect from 0, rejected ones too
};

/// Forces that are the same for all particles, and the factors of the exact step over one tick
/// (step.h).
struct StepParameters {
    vec3 acceleration;   // m/s^2
    float tickSeconds;   // s
    vec3 wind;           // m/s
    float dragPerTick;   // drag rate times tickSeconds
    float loss;          // 1 - exp(-dragPerTick), the part of the slip that is lost
    float velocityGain;  // loss / drag rate, s
    float positionGain;  // (tickSeconds - velocityGain) / drag rate, s^2
    uint dragHalvings;   // least n with dragPerTick <= 2^n
};

/// One emitter; ranges as low and (high - low).
struct EmitterParameters {
    vec3 position;
    uint shape;  // as scene::EmitterShape: 0 point, 1 sphere, 2 box, 3 disc (normal to axis)
    vec3 size;   // box, full edge lengths
    float radius;
    vec3 axis;         // unit; with tangent and bitangent orthonormal
    float coneHeight;  // 1 - cos(spread)
    vec3 tangent;
    float speedLow;
    vec3 bitangent;
    float speedRange;
    float lifetimeLowTicks;
    float lifetimeRangeTicks;
};

/// Consecutive births of one emitter in one tick. Birth i has birthRemaining = max(0, remaining - i
/// * remainingStep).
struct BirthBatch {
    uint emitter;
    uint firstBirthIndex;
    uint count;
    float remaining;
    float remainingStep;
};

/// A segment of the piecewise-linear curves over normalised age: it adds slope * clamp(age - start,
/// 0, width).
struct AppearanceSegment {
    float start;
    float width;
    float radiusSlope;
    float densitySlope;
    vec3 tintSlope;
};

/// Radius, density and tint over normalised age: the values at age 0 and the segments from there.
struct AppearanceParameters {
    float radius;
    float density;
    vec3 tint;
    uint segmentCount;
    AppearanceSegment segments[kMaxAppearanceKeys];
};

/// All that the simulation of an effect reads and never writes, besides its emitters.
struct EffectParameters {
    StepParameters step;
    RandomStream random;
    uint curlNoiseCount;
    CurlNoise curlNoise[kMaxFieldsPerType];
    AppearanceParameters appearance;
};

/// Totals since tick 0. alive = born - died; born + rejected = births asked for.
struct ParticleCounters {
    uint alive;
    uint born;
    uint died;
    uint rejected;  // births without a free slot
};

#ifdef __cplusplus
static_assert(sizeof(Particle) == 40);
static_assert(sizeof(StepParameters) == 48);
static_assert(offsetof(EmitterParameters, lifetimeLowTicks) == 80 &&
              sizeof(EmitterParameters) == 88);
static_assert(sizeof(BirthBatch) == 20);
static_assert(sizeof(AppearanceSegment) == 28);
static_assert(offsetof(EffectParameters, curlNoise) == 64);
static_assert(offsetof(EffectParameters, appearance) == 64 + 4 * sizeof(CurlNoise));
#endif

BRUME_STRUCTS_END

// Functions that look into the effect's arrays take it as an argument in C++; shaders define
// BRUME_EFFECT as the block they have bound, because a copy of the whole struct would be loaded per
// call.
#ifdef __cplusplus
#define BRUME_EFFECT effect
#define BRUME_EFFECT_PARAMETER const EffectParameters &effect,
#define BRUME_EFFECT_ARGUMENT effect,
#define BRUME_CURL_NOISE_COUNT effect.curlNoiseCount
#else
#define BRUME_EFFECT_PARAMETER
#define BRUME_EFFECT_ARGUMENT
#endif

#endif
