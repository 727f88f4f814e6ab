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
    uint chunk = threadIndex();
    if (chunk >= push.survivorChunks + push.birthChunks) return;

    uint count = 0u;
    uvec2 survivors = survivorRange(chunk, totals.counters.alive);
    for (uint i = survivors.x; i < survivors.y; ++i) count += isAlive(lives[i], push.tick) ? 1u : 0u;

    uvec2 births = birthRange(chunk);
    BatchCursor cursor = firstBatch();
    for (uint i = births.x; i < births.y; ++i) {
        BirthBatch batch = batchOf(i, cursor);
        EmitterParameters emitter = emitters[batch.emitter];
        ParticleLife life = spawnLife(effect.random, emitter, batch, i - cursor.first, push.tick);
        count += isAlive(life, push.tick) ? 1u : 0u;
    }
    chunks[chunk] = count;
}
