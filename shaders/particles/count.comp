#version 460
// SPDX-License-Identifier: Apache-2.0
// First pass of a tick: how many particles of each chunk outlive it.
#extension GL_GOOGLE_include_directive : require
#include "tick.glsl"

#include "effect_block.glsl"
#include "spawn.h"
#include "step.h"

#include "births.glsl"

layout(set = 0, binding = kBindingLives, scalar) readonly buffer LivesBlock { ParticleLife lives[]; };
layout(set = 0, binding = kBindingTotals, scalar) readonly buffer TotalsBlock { TickTotals totals; };
layout(set = 0, binding = kBindingChunks, scalar) writeonly buffer ChunksBlock { uint chunks[]; };

void main() {
    Tick tick = ticks[push.slot];
    uint chunk = threadIndex();
    if (chunk >= tick.survivorChunks + tick.birthChunks) return;

    uint count = 0u;
    uvec2 survivors = survivorRange(tick, chunk, totals.counters.alive);
    for (uint i = survivors.x; i < survivors.y; ++i) count += isAlive(lives[i], tick.index) ? 1u : 0u;

    uvec2 births = birthRange(tick, chunk);
    BatchCursor cursor = firstBatch(tick);
    for (uint i = births.x; i < births.y; ++i) {
        BirthBatch batch = batchOf(tick, i, cursor);
        EmitterParameters emitter = emitters[batch.emitter];
        ParticleLife life = spawnLife(effect.random, emitter, batch, i - cursor.first, tick.index);
        count += isAlive(life, tick.index) ? 1u : 0u;
    }
    chunks[chunk] = count;
}
