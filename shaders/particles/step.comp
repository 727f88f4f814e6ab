#version 460
// SPDX-License-Identifier: Apache-2.0
// Last pass of a tick: survivors advance and close up, births are appended; what sub-emitters make
// of it is listed per chunk.
#extension GL_GOOGLE_include_directive : require
#include "tick.glsl"

#include "effect_block.glsl"
layout(set = 0, binding = kBindingTriangles, scalar) readonly buffer TrianglesBlock { EmitterTriangle triangles[]; };
#define BRUME_TRIANGLES triangles
#include "children.h"

#include "births.glsl"
#include "state.glsl"

#define BRUME_NEW_STATE_WORD(k) \
    layout(set = 0, binding = kBindingNewState + k, scalar) writeonly buffer NewState##k { uint64_t newState##k[]; };
BRUME_NEW_STATE_WORD(0)
BRUME_NEW_STATE_WORD(1)
BRUME_NEW_STATE_WORD(2)
BRUME_NEW_STATE_WORD(3)
BRUME_NEW_STATE_WORD(4)
layout(set = 0, binding = kBindingChunks, scalar) readonly buffer ChunksBlock { uint chunks[]; };
layout(set = 0, binding = kBindingGroups, scalar) readonly buffer GroupsBlock { uint groups[]; };
layout(set = 0, binding = kBindingTotals, scalar) buffer TotalsBlock { TickTotals totals[]; };
layout(set = 0, binding = kBindingInstances, scalar) readonly buffer InstancesBlock { InstanceParameters instances[]; };
layout(set = 0, binding = kBindingInstanceTicks, scalar) readonly buffer InstanceTicksBlock { InstanceTick instanceTicks[]; };
layout(set = 0, binding = kBindingInstanceNoise, scalar) readonly buffer InstanceNoiseBlock { CurlNoiseShift instanceNoise[]; };
layout(set = 0, binding = kBindingStrands, scalar) readonly buffer StrandsBlock { uint strands[]; };
layout(set = 0, binding = kBindingNewStrands, scalar) writeonly buffer NewStrandsBlock { uint newStrands[]; };
layout(set = 0, binding = kBindingRecords, scalar) writeonly buffer RecordsBlock { BirthBatch records[]; };
layout(set = 0, binding = kBindingRecordCounts, scalar) writeonly buffer RecordCountsBlock { RecordCount recordCounts[]; };

/// Where an invocation stands.
struct Cursor {
    uint slot;    // of the next particle to write, in the instance
    uint base;    // first slot of the instance
    uint killed;  // not finite
    uint firstRecord;  // of its chunk, for sub-emitter 0
    uint recordStride;  // from one sub-emitter to the next
    RecordCount counts[kMaxSubEmitters];
};

void write(inout Cursor cursor, Particle particle, uint strand) {
    uint slot = cursor.base + cursor.slot;
    vec3 x = particle.position, v = particle.velocity;
    newState0[slot] = packUint2x32(floatBitsToUint(x.xy));
    newState1[slot] = packUint2x32(floatBitsToUint(vec2(x.z, v.x)));
    newState2[slot] = packUint2x32(floatBitsToUint(v.yz));
    newState3[slot] = packUint2x32(
        uvec2(particle.life.birthTick, floatBitsToUint(particle.life.birthRemaining)));
    newState4[slot] = packUint2x32(
        uvec2(floatBitsToUint(particle.life.lifetimeTicks), particle.birthIndex));
    if (kHasStrands != 0u) newStrands[slot] = strand;
    ++cursor.slot;
    cursor.killed += particle.life.lifetimeTicks == kNotFinite ? 1u : 0u;
}

void listChildren(inout Cursor cursor, RandomStream random, ParticleTick event) {
    for (uint k = 0u; k < kSubEmitterCount; ++k) {
        BirthBatch batch = childrenOf(effect.subEmitters[k], random, event);
        if (batch.count > 0u) {
            records[k * cursor.recordStride + cursor.firstRecord + cursor.counts[k].records] = batch;
            ++cursor.counts[k].records;
            cursor.counts[k].births += batch.count;
        }
    }
}

/// A particle that is alive or, where that has sub-emitters, dies in this tick.
void advance(inout Cursor cursor, StepParameters parameters, InstanceParameters instance,
             Tick tick, bool isBirth, bool survives, Particle particle, uint strand) {
    ParticleTick event = followTick(parameters, tick.fields, instance.noiseSeed, tick.index, isBirth,
                                    survives || kSubEmitterCount == 0u, particle);
    if (kSubEmitterCount > 0u) listChildren(cursor, instance.random, event);
    if (survives) write(cursor, particle, strand);
}

/// In world space instances have origins of their own: returns how far it moves before the tick.
vec3 takeInstanceTick(inout Tick tick, uint instance) {
    if (kIsWorld == 0u) return vec3(0);
    uint i = push.slot * tick.instances + instance;
    tick.fields.shift = instanceTicks[i].shift;
    for (uint k = 0u; k < curlNoiseCount; ++k)
        tick.fields.curlNoise[k] = instanceNoise[i * curlNoiseCount + k];
    return instanceTicks[i].rebase;
}

void stepSurvivors(Tick tick, InstanceParameters instance, vec3 rebase, uvec2 range,
                   inout Cursor cursor) {
    StepParameters parameters = effect.step;
    for (uint i = range.x; i < range.y; ++i) {
        Particle particle;
        uint slot = cursor.base + i;
        particle.life = loadLife(slot, particle.birthIndex);
        bool survives = isAlive(particle.life, tick.index);
        if (survives || kSubEmitterCount > 0u) {
            loadMotion(slot, particle.position, particle.velocity);
            if (kIsWorld != 0u) {
                precise vec3 position = particle.position - rebase;
                particle.position = position;
            }
            uint strand = kHasStrands != 0u ? strands[slot] : 0u;
            advance(cursor, parameters, instance, tick, false, survives, particle, strand);
        }
    }
}

void appendBirths(Tick tick, TickTotals before, uint instanceIndex, InstanceParameters instance,
                  uvec2 births, inout Cursor cursor) {
    StepParameters parameters = effect.step;
    uvec2 range = batchRange(tick, before, instanceIndex);
    uint index = findBatch(range, births.x);
    for (uint i = births.x; i < births.y; ++i) {
        BirthBatch batch = batchOf(range, i, index);
        Particle particle = spawnFromBatch(instance, emitters[batch.emitter], batch,
                                           i - batch.first, tick.index);
        bool survives = isAlive(particle.life, tick.index);
        if ((survives || kSubEmitterCount > 0u) && cursor.slot < tick.capacity)
            advance(cursor, parameters, instance, tick, true, survives, particle, batch.strand);
    }
}

void main() {
    Tick tick = ticks[push.slot];
    uint chunk = threadIndex();
    if (chunk >= tick.chunks * tick.instances) return;
    uint instanceIndex = chunk / tick.chunks;
    uint local = chunk - instanceIndex * tick.chunks;
    TickTotals before = totals[instanceIndex];
    InstanceParameters instance = instances[instanceIndex];

    Cursor cursor;
    cursor.slot = groups[instanceIndex * tick.groups + groupOf(tick, local)] + chunks[chunk];
    cursor.base = instanceIndex * tick.capacity;
    cursor.killed = 0u;
    cursor.firstRecord = chunk * tick.chunkSize;
    cursor.recordStride = tick.chunks * tick.instances * tick.chunkSize;
    for (uint k = 0u; k < kSubEmitterCount; ++k) cursor.counts[k] = RecordCount(0u, 0u);

    vec3 rebase = takeInstanceTick(tick, instanceIndex);
    stepSurvivors(tick, instance, rebase, survivorRange(tick, local, before.previousAlive), cursor);
    appendBirths(tick, before, instanceIndex, instance,
                 birthRange(tick, local, birthCountOf(tick, before)), cursor);
    if (cursor.killed > 0u) atomicAdd(totals[instanceIndex].counters.killed, cursor.killed);
    for (uint k = 0u; k < kSubEmitterCount; ++k)
        recordCounts[k * tick.chunks * tick.instances + chunk] = cursor.counts[k];
}
