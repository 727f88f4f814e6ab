// SPDX-License-Identifier: Apache-2.0
// The structs of the particle simulator that C++ and GLSL share (scalar block layout): the state of
// a particle and the parameters of an effect. An effect's time runs in integer ticks; tick k covers
// the time from k to k + 1 ticks.
#ifndef BRUME_SHADERS_PARTICLES_EFFECT_H
#define BRUME_SHADERS_PARTICLES_EFFECT_H

#include "../common/random.h"
#include "../common/shared_math.h"
#include "modules/modules.h"

BRUME_STRUCTS_BEGIN

BRUME_CONST uint kMaxModulesPerType = 8u;   // e.g. curl_noise modules in one effect
BRUME_CONST uint kMaxSubEmitters = 4u;      // of one effect
BRUME_CONST uint kMaxChildrenPerTick = 4096u;  // of one particle and sub-emitter
BRUME_CONST uint kMaxAppearanceKeys = 64u;  // over-life keys at different ages
BRUME_CONST uint kMaxSpeedKeys = 16u;       // by-speed keys at different speeds

// Random channels of a birth; each gives four words.
BRUME_CONST uint kChannelMotion = 0u;    // lifetime, speed, two for the direction
BRUME_CONST uint kChannelShape = 1u;     // the place in the shape
BRUME_CONST uint kChannelChildren = 2u;  // and up: how many children, per sub-emitter and tick:
                                         // 16 tick + 2 to 16 tick + 5
BRUME_CONST uint kChannelLook = 6u;      // rotation and spin of a billboard, thinning

/// When a particle was born and for how long; all that decides its death by age.
struct ParticleLife {
    uint birthTick;        // the tick in which it was born
    float birthRemaining;  // part of that tick that was left at birth, [0, 1]; sign bit: it sticks
    float lifetimeTicks;   // negative: killed
};

/// The hot state, 40 bytes; on the GPU one array per field. Metres and m/s in effect space, or, of
/// effects in world space, along the world's axes from the instance's origin at the time.
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
    float restSpeed;     // slower hits do not bounce, m/s
    float ticksPerSecond;
};

BRUME_CONST uint kNoField = 0xffffffffu;

/// One emitter; ranges as low and (high - low). See spawn.h for the shapes.
struct EmitterParameters {
    vec3 position;
    uint shape;     // kShape*
    vec3 size;      // box: full edge lengths; line: from its start to its end
    float radius;   // sphere, disc, ring, cone (at its base)
    vec3 axis;      // of the shape: unit; with tangent and bitangent orthonormal
    float height;   // cone
    vec3 tangent;
    float innerRadius2;  // disc: (inner radius / radius)^2
    vec3 bitangent;
    uint isSurface;   // sphere, box, cone: births on the surface, not in the volume
    vec3 direction;   // of the velocity: unit; with the next two orthonormal
    uint velocityMode;  // kVelocity*
    vec3 directionTangent;
    float coneHeight;  // 1 - cos(spread)
    vec3 directionBitangent;
    float speedLow;
    float speedRange;
    float lifetimeLowTicks;
    float lifetimeRangeTicks;
    float inheritPerTick;   // share of the emitter's velocity, times the tick rate
    float inheritSpeed;     // share of the parent's velocity
    float faceX, faceXY;    // box surface: shares of the area of the faces across x, across x and y
    uint firstTriangle;     // mesh
    uint triangleCount;
    uint birthField;  // whose velocity is added at birth; kNoField: none
};

/// A triangle that emits; `rank` / 2^32 is the share of the area in the triangles before it.
struct EmitterTriangle {
    vec3 corner;
    vec3 edge1;
    vec3 edge2;
    vec3 normal;  // unit, outwards
    uint rank;
};

/// Consecutive births of one emitter in one tick. Birth i has birthRemaining r = max(0, remaining -
/// i * remainingStep), when the emitter was at offset - r * motion.
struct BirthBatch {
    uint emitter;
    uint firstBirthIndex;
    uint count;
    uint first;  // births of this tick before this batch
    float remaining;
    float remainingStep;
    uint strand;    // birth index of the parent
    vec3 offset;    // of the emitter from its place at the end of the tick, m
    vec3 motion;    // of the emitter in the tick, m
    vec3 velocity;  // of the parent, m/s
};

/// A sub-emitter, in the effect of the parents.
struct SubEmitter {
    uint trigger;         // kOn*
    uint index;           // among those of its effect
    float countLow;       // children per event; the fraction is a probability
    float countRange;
    float ratePerTick;    // children per tick, for trails
    float ticksPerBirth;  // 1 / ratePerTick
};

/// What the modules know about the current tick besides their parameters.
struct TickFields {
    CurlNoiseShift curlNoise[kMaxModulesPerType];
    vec3 shift;  // world space: from the particles' origin to that of the modules, m
};

/// World space: what a tick of an instance has besides.
struct InstanceTick {
    vec3 rebase;  // by which the origin moves before the tick, m
    vec3 shift;   // as TickFields::shift
};

/// What makes an instance of an effect differ from the others.
struct InstanceParameters {
    RandomStream random;
    uint noiseSeed;
    vec3 axisX;  // world space: columns of the linear map from effect space to the world
    vec3 axisY;
    vec3 axisZ;
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

/// The same over speed in m/s, for factors of radius and density.
struct SpeedSegment {
    float start;
    float width;
    float radiusSlope;
    float densitySlope;
};

/// Radius, density and tint over normalised age: the values at age 0 and the segments from there;
/// factors of radius and density over speed likewise, from 0 m/s.
struct AppearanceParameters {
    float radius;
    float density;
    vec3 tint;
    uint segmentCount;
    AppearanceSegment segments[kMaxAppearanceKeys];
    float radiusFactor;
    float densityFactor;
    uint speedSegmentCount;
    SpeedSegment speedSegments[kMaxSpeedKeys];
    float thinningDistance;  // m; 0: none
    float thinningLeast;     // share that is always kept
};

/// All that the simulation of an effect reads and never writes, besides its emitters.
struct EffectParameters {
    StepParameters step;
#define BRUME_DECLARE_MODULE(Type, member, constant) \
    uint member##Count;                              \
    Type member[kMaxModulesPerType];
    BRUME_MODULE_TYPES(BRUME_DECLARE_MODULE)
#undef BRUME_DECLARE_MODULE
    SubEmitter subEmitters[kMaxSubEmitters];
    uint isWorld;  // 1: particles live in the world's space
    AppearanceParameters appearance;
};

/// Totals since tick 0. alive = born - died; born + rejected = births asked for.
struct ParticleCounters {
    uint alive;
    uint born;
    uint died;
    uint rejected;  // births without a free slot
    uint killed;    // of those that died: neither finite place nor finite velocity
};

#ifdef __cplusplus
static_assert(sizeof(Particle) == 40);
static_assert(sizeof(StepParameters) == 56);
static_assert(offsetof(EmitterParameters, directionBitangent) == 112 &&
              sizeof(EmitterParameters) == 168);
static_assert(sizeof(BirthBatch) == 64);
static_assert(sizeof(EmitterTriangle) == 52);
static_assert(sizeof(AppearanceSegment) == 28);
static_assert(offsetof(EffectParameters, curlNoise) == 60);
#endif

BRUME_STRUCTS_END

// Functions that look into the effect's arrays take it as an argument in C++; shaders define
// BRUME_EFFECT as the block they have bound, because a copy of the whole struct would be loaded per
// call, and each count and kind as a specialisation constant (effect_block.glsl).
#ifdef __cplusplus
#define BRUME_EFFECT effect
#define BRUME_EFFECT_PARAMETER const EffectParameters &effect,
#define BRUME_EFFECT_ARGUMENT effect,
#define BRUME_COUNT(member) effect.member##Count
#define BRUME_IS_WORLD (effect.isWorld != 0u)
#define BRUME_IS_THINNED (effect.appearance.thinningDistance > 0.0f)
#define BRUME_TRIANGLES triangles
#define BRUME_TRIANGLES_PARAMETER const EmitterTriangle *triangles,
#define BRUME_TRIANGLES_ARGUMENT triangles,
#else
#define BRUME_TRIANGLES_PARAMETER
#define BRUME_TRIANGLES_ARGUMENT
#define BRUME_EFFECT_PARAMETER
#define BRUME_EFFECT_ARGUMENT
#define BRUME_COUNT(member) member##Count
#define BRUME_IS_WORLD (kIsWorld != 0u)
#define BRUME_IS_THINNED (kIsThinned != 0u)
#endif

#endif
