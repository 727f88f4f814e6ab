// SPDX-License-Identifier: Apache-2.0
// Sub-emitters: what happens to a particle in a tick becomes a batch of births of another effect.
// Batches are made in the order of the parents, so that the order of the children is a function of
// theirs. Limits: the children of a trail lie on the straight way of the tick, bounces or not.
#ifndef BRUME_SHADERS_PARTICLES_CHILDREN_H
#define BRUME_SHADERS_PARTICLES_CHILDREN_H

#include "spawn.h"
#include "step.h"

BRUME_STRUCTS_BEGIN

// As scene::SubEmitterTrigger.
BRUME_CONST uint kOnBirth = 0u;
BRUME_CONST uint kOnDeath = 1u;
BRUME_CONST uint kOnCollision = 2u;
BRUME_CONST uint kOnWay = 3u;  // by rate, a trail

/// A particle's tick: from `start` to `end`, [from, to] in parts of the tick.
struct ParticleTick {
    uint tick;
    uint isBirth;  // it was born in this tick
    uint isDeath;  // it dies in it, at `end`
    float from;
    float to;
    vec3 start;
    vec3 end;
    vec3 startVelocity;
    vec3 endVelocity;
    ParticleLife life;
    uint birthIndex;
    StepOutcome outcome;
};

/// Part of the tick at which a particle that dies in it does so; what was killed in the tick before
/// dies at the start.
BRUME_SHARED float partOfDeath(ParticleLife life, uint tick, float from) {
    BRUME_PRECISE float part = life.lifetimeTicks - ageTicks(life, tick) + 1.0f;
    part = part > from ? part : from;
    return life.lifetimeTicks < 0.0f ? from : part < 1.0f ? part : 1.0f;
}

BRUME_SHARED BirthBatch noChildren() {
    BirthBatch batch;
    batch.emitter = 0u;
    batch.firstBirthIndex = 0u;
    batch.count = 0u;
    batch.first = 0u;
    batch.remaining = 0.0f;
    batch.remainingStep = 0.0f;
    batch.strand = 0u;
    batch.offset = vec3(0.0f);
    batch.motion = vec3(0.0f);
    batch.velocity = vec3(0.0f);
    return batch;
}

/// Takes a particle through a tick, to its death if it does not survive; births have only the part
/// that is left of it.
BRUME_SHARED ParticleTick followTick(BRUME_EFFECT_PARAMETER BRUME_FIELDS_PARAMETER
                                         StepParameters parameters,
                                     TickFields fields, uint noiseSeed, uint tick, bool isBirth,
                                     bool survives, BRUME_INOUT(Particle) particle) {
    ParticleTick event;
    event.tick = tick;
    event.isBirth = isBirth ? 1u : 0u;
    event.isDeath = survives ? 0u : 1u;
    BRUME_PRECISE float from = isBirth ? 1.0f - partOfFirstTick(particle.life) : 0.0f;
    event.from = from;
    event.to = survives ? 1.0f : partOfDeath(particle.life, tick, from);
    event.start = particle.position;
    event.startVelocity = particle.velocity;
    event.life = particle.life;
    event.birthIndex = particle.birthIndex;
    // The whole tick has its factors ready. One call for both: shaders hold all modules once each.
    StepParameters step = parameters;
    if (isBirth || !survives) {
        BRUME_PRECISE float part =
            survives ? partOfFirstTick(particle.life) : event.to - event.from;
        step = partOfStep(parameters, part);
    }
    event.outcome = stepParticle(BRUME_EFFECT_ARGUMENT BRUME_FIELDS_ARGUMENT step, fields,
                                 noiseSeed, particle);
    event.end = particle.position;
    event.endVelocity = particle.velocity;
    return event;
}

/// A number of children with the fraction as a probability.
BRUME_SHARED uint childCount(SubEmitter sub, RandomStream random, uint birthIndex, uint tick) {
    // A particle is born and dies once, but may collide in many ticks.
    uint draw = sub.trigger == kOnCollision ? tick : 0u;
    uvec4 words = randomWords(random, birthIndex, kChannelChildren + sub.index + draw * 16u);
    BRUME_PRECISE float count =
        sub.countLow + sub.countRange * unitFloat(words.x) + unitFloat(words.y);
    return uint(floor(count));
}

/// The children along the way: the j-th (from 1) is born at age j / rate.
BRUME_SHARED BirthBatch trailChildren(SubEmitter sub, ParticleTick event) {
    BRUME_PRECISE float age = ageTicks(event.life, event.tick);
    BRUME_PRECISE float before =
        event.isBirth != 0u ? 0.0f : ageTicks(event.life, event.tick - 1u);
    BRUME_PRECISE float after = event.isDeath != 0u ? age - (1.0f - event.to) : age;
    BRUME_PRECISE float low = floor(before * sub.ratePerTick);
    BRUME_PRECISE float high = floor(after * sub.ratePerTick);
    BRUME_PRECISE float span = event.to - event.from;
    BirthBatch batch = noChildren();
    bool isAny = high > low && span > 1e-6f;
    BRUME_PRECISE float count = high - low;
    batch.count = isAny ? uint(count) : 0u;
    BRUME_PRECISE float first = age - (low + 1.0f) * sub.ticksPerBirth;
    first = first > 0.0f ? first : 0.0f;
    batch.remaining = first < 1.0f ? first : 1.0f;
    batch.remainingStep = sub.ticksPerBirth;
    BRUME_PRECISE vec3 motion =
        (event.end - event.start) * reciprocalReplayable(isAny ? span : 1.0f);
    BRUME_PRECISE vec3 offset = event.end + motion * (1.0f - event.to);
    batch.motion = motion;
    batch.offset = offset;
    return batch;
}

/// The children that the sub-emitter gives for a particle's tick; `first` and `firstBirthIndex` are
/// for the caller to fill in.
BRUME_SHARED BirthBatch childrenOf(SubEmitter sub, RandomStream random, ParticleTick event) {
    BirthBatch batch = noChildren();
    bool isBirth = sub.trigger == kOnBirth && event.isBirth != 0u;
    // What is not finite any more has no place to leave children.
    bool isDeath = sub.trigger == kOnDeath && event.isDeath != 0u &&
                   event.life.lifetimeTicks != kNotFinite;
    bool isCollision = sub.trigger == kOnCollision && event.outcome.hasHit != 0u;
    if (sub.trigger == kOnWay) {
        batch = trailChildren(sub, event);
    } else if (isBirth || isDeath || isCollision) {
        batch.count = childCount(sub, random, event.birthIndex, event.tick);
        BRUME_PRECISE float remaining = 1.0f - (isBirth ? event.from : event.to);
        batch.remaining = isCollision ? event.outcome.hitRemaining : remaining;
        batch.offset = isBirth  ? event.start
                       : isDeath ? event.end
                                 : event.outcome.hitPosition;
        batch.velocity = isBirth  ? event.startVelocity
                         : isDeath ? event.endVelocity
                                   : event.outcome.hitVelocity;
    }
    batch.strand = event.birthIndex;
    batch.count = batch.count < kMaxChildrenPerTick ? batch.count : kMaxChildrenPerTick;
    return batch;
}

BRUME_STRUCTS_END
#endif
