// SPDX-License-Identifier: Apache-2.0
// What colliders have in common: the earliest hit on a straight way, and what it does.
#ifndef BRUME_SHADERS_PARTICLES_CONTACT_H
#define BRUME_SHADERS_PARTICLES_CONTACT_H

#include "../common/replayable_math.h"

BRUME_STRUCTS_BEGIN

BRUME_CONST uint kResponseBounce = 0u;
BRUME_CONST uint kResponseStick = 1u;
BRUME_CONST uint kResponseKill = 2u;
BRUME_CONST uint kResponseWait = 3u;  // no hit: the way ends here until the next tick

/// How a surface treats what hits it.
struct ContactSurface {
    float restitution;  // speed along the normal after / before, 0 to 1
    float friction;     // Coulomb's coefficient
    uint response;      // kResponse*
};

/// The earliest hit found so far on a way of length 1 in `time`.
struct Hit {
    float time;  // part of the way, [0, 1]; 2: none
    vec3 position;
    vec3 normal;  // unit, away from the surface, on the side where particles are allowed
    float restitution;  // as in ContactSurface
    float friction;
    uint response;
};

BRUME_SHARED Hit noHit() {
    Hit hit;
    hit.time = 2.0f;
    hit.position = vec3(0.0f);
    hit.normal = vec3(0.0f, 1.0f, 0.0f);
    hit.restitution = 0.0f;
    hit.friction = 0.0f;
    hit.response = kResponseBounce;
    return hit;
}

/// Keeps the earlier of two hits, the older one on a tie.
BRUME_SHARED void keepEarlier(BRUME_INOUT(Hit) hit, bool isHit, float time, vec3 position,
                              vec3 normal, ContactSurface surface) {
    if (isHit && time < hit.time) {
        hit.time = time;
        hit.position = position;
        hit.normal = normal;
        hit.restitution = surface.restitution;
        hit.friction = surface.friction;
        hit.response = surface.response;
    }
}

/// `velocity` after an impulse along `normal` that was met with `impulse` (per mass, >= 0) by the
/// surface: friction takes at most friction * impulse of the speed along the surface (Coulomb).
BRUME_SHARED vec3 rubVelocity(vec3 velocity, vec3 normal, float impulse, float friction) {
    BRUME_PRECISE vec3 along = velocity - normal * dotReplayable(velocity, normal);
    BRUME_PRECISE float speed = lengthReplayable(along);
    BRUME_PRECISE float loss = friction * impulse;
    BRUME_PRECISE float share =
        loss < speed ? loss * reciprocalReplayable(speed) : (speed > 0.0f ? 1.0f : 0.0f);
    BRUME_PRECISE vec3 rubbed = velocity - along * share;
    return rubbed;
}

BRUME_STRUCTS_END
#endif
