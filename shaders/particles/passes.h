// SPDX-License-Identifier: Apache-2.0
// What the compute passes of the simulator are given; C++ and GLSL.
//
// A tick is four dispatches. Particles are handled in chunks of consecutive ones, a chunk per
// invocation, so that survivors keep their order: count (survivors per chunk), offsets (prefix sums
// within groups of chunks), totals (prefix sum of the groups, new counters), step (advance the
// survivors and write them behind each other). The births follow as chunks of their own, in groups
// of their own. All instances of an effect go through the same ticks in the same dispatches, one
// after the other in every array. For each sub-emitter two more follow: child_offsets (prefix sums
// of the batches that the step has listed) and child_batches (batches in a row, as the births of
// the child's tick).
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
BRUME_CONST uint kBindingTotals = 11u;    // TickTotals[], by instance
BRUME_CONST uint kBindingEmitters = 12u;  // EmitterParameters[]
BRUME_CONST uint kBindingBatches = 13u;   // BirthBatch[] of several ticks, or of all instances
BRUME_CONST uint kBindingTicks = 14u;     // Tick[]
BRUME_CONST uint kBindingParticleSpheres = 15u;  // SphereData[]
BRUME_CONST uint kBindingInstances = 16u;        // InstanceParameters[]
BRUME_CONST uint kBindingTriangles = 17u;        // EmitterTriangle[]
BRUME_CONST uint kBindingRecords = 18u;       // BirthBatch[]: sub-emitter, instance, chunk, record
BRUME_CONST uint kBindingRecordCounts = 19u;  // RecordCount[]: sub-emitter, instance, chunk
BRUME_CONST uint kBindingChildTotals = 20u;   // TickTotals[] of the child
BRUME_CONST uint kBindingChildBatches = 21u;  // BirthBatch[] of the child
// 22: kBindingFieldValues of field_grid.h
BRUME_CONST uint kBindingStrands = 23u;       // uint[], before the tick; of effects with ribbons
BRUME_CONST uint kBindingNewStrands = 24u;    // after it

/// One tick, as the CPU knows it beforehand.
///
/// It lies in a storage buffer, because lavapipe (Mesa 22.3) compiles a pipeline anew each time it
/// is bound if push constants or uniform blocks decide about its control flow.
struct Tick {
    uint capacity;   // of one instance
    uint instances;
    uint index;
    uint chunkSize;
    uint survivorChunks;  // of one instance: chunks of existing particles
    uint chunks;          // of one instance: those and the chunks of births
    uint groups;          // of one instance
    uint firstBatch;
    uint batchCount;
    uint birthCount;
    uint overflow;     // births rejected beforehand
    uint slots;        // after the tick no instance has more particles alive
    uint isChild;      // births come from a sub-emitter
    uint batchStride;  // then: batches of one instance
    TickFields fields;
};

/// The counters of an instance and what a tick keeps between its dispatches.
struct TickTotals {
    ParticleCounters counters;
    uint previousAlive;  // before the tick
    uint slots;          // Tick::slots of the last tick
    uint births;         // asked for by sub-emitters, at most the capacity
    uint overflow;       // more than that
    uint batchCount;     // of sub-emitters
};

/// Children that a chunk of parents asks for; then those of the chunks before it.
struct RecordCount {
    uint records;
    uint births;
};

/// Push constants of the four passes of a tick.
struct TickPush {
    uint slot;  // in the buffer of ticks
};

/// Push constants of the two passes of a sub-emitter.
struct ChildPush {
    uint slot;  // of the parent's tick
    uint sub;
    uint capacity;     // of the child, per instance
    uint batchStride;  // of the child's batches, per instance
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
    uint isShadowedWhole;  // else at each place
    uint instance;
    uint firstSlot;          // of the instance
    float sinceTick;         // ticks since the end of lastTick, [0, 1)
    float sinceTickSeconds;  // the same in seconds
};

BRUME_STRUCTS_END

#ifdef __cplusplus
static_assert(offsetof(brume::shader::AppearancePush, radiusScale) == 60);
#endif
#endif
