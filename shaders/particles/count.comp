#version 460
// SPDX-License-Identifier: Apache-2.0
// First pass of a tick: how many particles of each chunk outlive it.
#extension GL_GOOGLE_include_directive : require
#include "tick.glsl"

#include "effect_block.glsl"
layout(set = 0, binding = kBindingTriangles, scalar) readonly buffer TrianglesBlock { EmitterTriangle triangles[]; };
#define BRUME_TRIANGLES triangles
#include "spawn.h"
#include "step.h"

#include "births.glsl"
#include "state.glsl"

layout(set = 0, binding = kBindingTotals, scalar) readonly buffer TotalsBlock { TickTotals totals[]; };
layout(set = 0, binding = kBindingInstances, scalar) readonly buffer InstancesBlock { InstanceParameters instances[]; };
layout(set = 0, binding = kBindingChunks, scalar) writeonly buffer ChunksBlock { uint chunks[]; };

void main() {
    Tick tick = ticks[push.slot];
    uint chunk = threadIndex();
    if (chunk >= tick.chunks * tick.instances) return;
    uint instance = chunk / tick.chunks;
    uint local = chunk - instance * tick.chunks;
    TickTotals before = totals[instance];

    uint count = 0u;
    uvec2 survivors = survivorRange(tick, local, before.counters.alive);
    uint base = instance * tick.capacity;
    uint birthIndex;
    for (uint i = survivors.x; i < survivors.y; ++i)
        count += isAlive(loadLife(base + i, birthIndex), tick.index) ? 1u : 0u;

    RandomStream random = instances[instance].random;
    uvec2 births = birthRange(tick, local, birthCountOf(tick, before));
    uvec2 range = batchRange(tick, before, instance);
    uint index = findBatch(range, births.x);
    for (uint i = births.x; i < births.y; ++i) {
        BirthBatch batch = batchOf(range, i, index);
        EmitterParameters emitter = emitters[batch.emitter];
        uint inBatch = i - batch.first;
        ParticleLife life = spawnLife(random, emitter, batch.firstBirthIndex + inBatch,
                                      remainingOf(batch, inBatch), tick.index);
        count += isAlive(life, tick.index) ? 1u : 0u;
    }
    chunks[chunk] = count;
}
