#version 460
// SPDX-License-Identifier: Apache-2.0
// Last pass of a tick: survivors advance and close up, births are appended.
#extension GL_GOOGLE_include_directive : require
#include "tick.glsl"

#include "effect_block.glsl"
#include "spawn.h"
#include "step.h"

#include "births.glsl"

layout(set = 0, binding = kBindingPositions, scalar) readonly buffer PositionsBlock { vec3 positions[]; };
layout(set = 0, binding = kBindingVelocities, scalar) readonly buffer VelocitiesBlock { vec3 velocities[]; };
layout(set = 0, binding = kBindingLives, scalar) readonly buffer LivesBlock { ParticleLife lives[]; };
layout(set = 0, binding = kBindingBirthIndices, scalar) readonly buffer BirthIndicesBlock { uint birthIndices[]; };
layout(set = 0, binding = kBindingNewPositions, scalar) writeonly buffer NewPositionsBlock { vec3 newPositions[]; };
layout(set = 0, binding = kBindingNewVelocities, scalar) writeonly buffer NewVelocitiesBlock { vec3 newVelocities[]; };
layout(set = 0, binding = kBindingNewLives, scalar) writeonly buffer NewLivesBlock { ParticleLife newLives[]; };
layout(set = 0, binding = kBindingNewBirthIndices, scalar) writeonly buffer NewBirthIndicesBlock { uint newBirthIndices[]; };
layout(set = 0, binding = kBindingChunks, scalar) readonly buffer ChunksBlock { uint chunks[]; };
layout(set = 0, binding = kBindingGroups, scalar) readonly buffer GroupsBlock { uint groups[]; };
layout(set = 0, binding = kBindingTotals, scalar) readonly buffer TotalsBlock { TickTotals totals; };

void write(uint slot, Particle particle) {
    newPositions[slot] = particle.position;
    newVelocities[slot] = particle.velocity;
    newLives[slot] = particle.life;
    newBirthIndices[slot] = particle.birthIndex;
}

void stepSurvivors(Tick tick, uvec2 range, uint slot) {
    StepParameters parameters = effect.step;
    for (uint i = range.x; i < range.y; ++i) {
        Particle particle;
        particle.life = lives[i];
        if (isAlive(particle.life, tick.index)) {
            particle.position = positions[i];
            particle.velocity = velocities[i];
            particle.birthIndex = birthIndices[i];
            stepParticle(parameters, particle);
            write(slot, particle);
            ++slot;
        }
    }
}

void appendBirths(Tick tick, uvec2 range, uint slot) {
    StepParameters parameters = effect.step;
    BatchCursor cursor = firstBatch(tick);
    for (uint i = range.x; i < range.y; ++i) {
        BirthBatch batch = batchOf(tick, i, cursor);
        Particle particle = spawnParticle(effect.random, emitters[batch.emitter], batch,
                                          i - cursor.first, tick.index);
        if (isAlive(particle.life, tick.index) && slot < tick.capacity) {
            stepNewParticle(parameters, particle);
            write(slot, particle);
            ++slot;
        }
    }
}

void main() {
    Tick tick = ticks[push.slot];
    uint chunk = threadIndex();
    if (chunk >= tick.survivorChunks + tick.birthChunks) return;
    uint slot = groups[groupOf(tick, chunk)] + chunks[chunk];
    stepSurvivors(tick, survivorRange(tick, chunk, totals.previousAlive), slot);
    appendBirths(tick, birthRange(tick, chunk), slot);
}
