// SPDX-License-Identifier: Apache-2.0
// A half space that particles cannot enter.
#ifndef BRUME_SHADERS_PARTICLES_MODULES_COLLIDE_PLANE_H
#define BRUME_SHADERS_PARTICLES_MODULES_COLLIDE_PLANE_H

#include "../contact.h"

BRUME_STRUCTS_BEGIN

struct PlaneCollider {
    vec3 normal;  // unit
    float offset;  // particles stay at dot(normal, x) >= offset, m
    ContactSurface surface;
};

BRUME_SHARED void sweepPlane(PlaneCollider plane, vec3 start, vec3 end, BRUME_INOUT(Hit) hit) {
    BRUME_PRECISE float before = dotReplayable(plane.normal, start) - plane.offset;
    BRUME_PRECISE float after = dotReplayable(plane.normal, end) - plane.offset;
    BRUME_PRECISE float time =
        before > 0.0f && after < 0.0f ? before * reciprocalReplayable(before - after) : 0.0f;
    BRUME_PRECISE vec3 place = start + (end - start) * time;
    place = place - plane.normal * (dotReplayable(plane.normal, place) - plane.offset);
    keepEarlier(hit, after < 0.0f, time, place, plane.normal, plane.surface);
}

BRUME_STRUCTS_END
#endif
