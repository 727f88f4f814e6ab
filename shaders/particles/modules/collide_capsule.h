// SPDX-License-Identifier: Apache-2.0
// A rod with round ends that particles cannot enter.
// Equations: the way against the cylinder around the rod, and where that is met beyond an end,
// against the ball there.
#ifndef BRUME_SHADERS_PARTICLES_MODULES_COLLIDE_CAPSULE_H
#define BRUME_SHADERS_PARTICLES_MODULES_COLLIDE_CAPSULE_H

#include "../contact.h"

BRUME_STRUCTS_BEGIN

struct CapsuleCollider {
    vec3 start;     // of the rod, m
    float extent;   // length of the rod, m
    vec3 axis;      // unit, from start to end
    float radius;   // m, that of the particles included
    ContactSurface surface;
};

/// The way of `position` from the nearest point of the rod.
BRUME_SHARED vec3 capsuleOffset(CapsuleCollider capsule, vec3 position) {
    BRUME_PRECISE vec3 m = position - capsule.start;
    BRUME_PRECISE float along = dotReplayable(m, capsule.axis);
    along = along > 0.0f ? along : 0.0f;
    along = along < capsule.extent ? along : capsule.extent;
    BRUME_PRECISE vec3 offset = m - capsule.axis * along;
    return offset;
}

/// When the way m + t way enters the ball of that radius around 0; 2 if never (t >= 0).
BRUME_SHARED float enterRound(vec3 m, vec3 way, float radius) {
    BRUME_PRECISE float a = dotReplayable(way, way);
    BRUME_PRECISE float b = dotReplayable(m, way);
    BRUME_PRECISE float c = dotReplayable(m, m) - radius * radius;
    BRUME_PRECISE vec3 across = m - way * (b * reciprocalReplayable(a > 0.0f ? a : 1.0f));
    BRUME_PRECISE float room = a * (radius * radius - dotReplayable(across, across));
    bool isHit = b < 0.0f && room > 0.0f && c >= 0.0f;
    BRUME_PRECISE float root = sqrtReplayable(isHit ? room : 0.0f);
    BRUME_PRECISE float time = c * reciprocalReplayable(isHit ? root - b : 1.0f);
    return isHit ? time : 2.0f;
}

BRUME_SHARED void sweepCapsule(CapsuleCollider capsule, vec3 start, vec3 end,
                               BRUME_INOUT(Hit) hit) {
    BRUME_PRECISE vec3 way = end - start;
    BRUME_PRECISE vec3 m = start - capsule.start;
    BRUME_PRECISE float wayAlong = dotReplayable(way, capsule.axis);
    BRUME_PRECISE float startAlong = dotReplayable(m, capsule.axis);
    BRUME_PRECISE float side =
        enterRound(m - capsule.axis * startAlong, way - capsule.axis * wayAlong, capsule.radius);
    BRUME_PRECISE float along = startAlong + wayAlong * side;
    bool isSide = side <= 1.0f && along >= 0.0f && along <= capsule.extent;
    BRUME_PRECISE float first = enterRound(m, way, capsule.radius);
    BRUME_PRECISE float second =
        enterRound(m - capsule.axis * capsule.extent, way, capsule.radius);
    BRUME_PRECISE float time = first < second ? first : second;
    time = isSide && side < time ? side : time;

    // Starts inside: pushed out, unless it leaves by itself.
    BRUME_PRECISE vec3 from = capsuleOffset(capsule, start);
    BRUME_PRECISE vec3 to = capsuleOffset(capsule, end);
    BRUME_PRECISE float radius2 = capsule.radius * capsule.radius;
    bool startsInside = dotReplayable(from, from) < radius2;
    bool isHit = startsInside
                     ? dotReplayable(from, way) < 0.0f || dotReplayable(to, to) < radius2
                     : time <= 1.0f;
    time = startsInside ? 0.0f : time;

    BRUME_PRECISE vec3 place = start + way * (isHit ? time : 0.0f);
    BRUME_PRECISE vec3 offset = capsuleOffset(capsule, place);
    BRUME_PRECISE vec3 tangent, bitangent;
    frameReplayable(capsule.axis, tangent, bitangent);
    BRUME_PRECISE vec3 normal = directionReplayable(offset, tangent);
    BRUME_PRECISE vec3 surfacePlace = place - offset + normal * capsule.radius;
    keepEarlier(hit, isHit, time, surfacePlace, normal, capsule.surface);
}

BRUME_STRUCTS_END
#endif
