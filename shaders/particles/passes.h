// SPDX-License-Identifier: Apache-2.0
// What the compute passes of the simulator are given; C++ and GLSL.
//
// A tick is four dispatches. Particles are handled in chunks of consecutive ones, a chunk per
// invocation, so that survivors keep their order: count (survivors per chunk), offsets (prefix sums
// within groups of chunks), totals (prefix sum of the groups, new counters), step (advance the
// survivors and write them behind each other). The births follow as chunks of their own, in groups
// of their own.
#ifndef BRUME_SHADERS_PARTICLES_PASSES_H
#define BRUME_SHADERS_PARTICLES_PASSES_H

#include "../common/shared_math.h"
#include "../common/sphere.h"
#include "effect.h"

BRUME_STRUCTS_BEGIN

BRUME_CONST uint kChunksPerGroup = 64u;

// Bindings; each pass has those that it uses. A state is an array per field, over the capacity.
BRUME_CONST uint kBindingEffect = 0u;     // EffectParameters
BRUME_CONST uint kBindingPositions = 1u;  // before the tick
BRUME_CONST uint kBindingVelocities = 2u;
BRUME_CONST uint kBindingLives = 3u;
BRUME_CONST uint kBindingBirthIndices = 4u;
BRUME_CONST uint kBindingNewPositions = 5u;  // after the tick
BRUME_CONST uint kBindingNewVelocities = 6u;
BRUME_CONST uint kBindingNewLives = 7u;
BRUME_CONST uint kBindingNewBirthIndices = 8u;
BRUME_CONST uint kBindingChunks = 9u;     // uint[]: count, then offset of each chunk in its group
BRUME_CONST uint kBindingGroups = 10u;    // uint[]: count, then offset of each group
BRUME_CONST uint kBindingTotals = 11u;    // TickTotals
BRUME_CONST uint kBindingEmitters = 12u;  // EmitterParameters[]
BRUME_CONST uint kBindingBatches = 13u;   // BirthBatch[] of several ticks
BRUME_CONST uint kBindingTicks = 14u;     // Tick[]
BRUME_CONST uint kBindingParticleSpheres = 15u;  // SphereData[]

/// One tick, as the CPU knows it beforehand.
///
/// It lies in a storage buffer, because lavapipe (Mesa 22.3) compiles a pipeline anew each time it
/// is bound if push constants or uniform blocks decide about its control flow.
struct Tick {
    uint capacity;
    uint index;
    uint chunkSize;
    uint survivorChunks;  // chunks of existing particles
    uint birthChunks;
    uint firstBatch;
    uint batchCount;
    uint birthCount;
    uint overflow;  // births rejected beforehand
    uint slots;     // after the tick no more particles than that are alive
};

/// The counters and what a tick keeps between its dispatches.
struct TickTotals {
    ParticleCounters counters;
    uint previousAlive;  // before the tick
    uint slots;          // Tick::slots of the last tick
};

/// Push constants of the four passes of a tick.
struct TickPush {
    uint slot;  // in the buffer of ticks
};

/// Push constants of the pass that writes the spheres.
struct AppearancePush {
    vec3 axisX;  // columns of the affine map from effect space to the camera's space
    vec3 axisY;
    vec3 axisZ;
    vec3 origin;
    vec3 originLo;  // what rounding has taken from it
    float radiusScale;
    uint firstSphere;
    uint lastTick;
    uint medium;
    uint firstId;
    uint profile;
};

BRUME_STRUCTS_END

#ifdef __cplusplus
static_assert(offsetof(brume::shader::AppearancePush, radiusScale) == 60);
#endif
#endif
