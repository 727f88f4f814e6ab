// SPDX-License-Identifier: Apache-2.0
// A ball that particles cannot enter, or cannot leave.
#ifndef BRUME_SHADERS_PARTICLES_MODULES_COLLIDE_SPHERE_H
#define BRUME_SHADERS_PARTICLES_MODULES_COLLIDE_SPHERE_H

#include "../contact.h"

BRUME_STRUCTS_BEGIN

struct SphereCollider {
    vec3 center;     // m
    float radius;    // m, that of the particles included
    uint isHollow;   // particles stay inside
    ContactSurface surface;
};

BRUME_SHARED void sweepSphere(SphereCollider sphere, vec3 start, vec3 end, BRUME_INOUT(Hit) hit) {
    BRUME_PRECISE vec3 way = end - start;
    BRUME_PRECISE vec3 m = start - sphere.center;
    BRUME_PRECISE vec3 n = end - sphere.center;
    BRUME_PRECISE float radius2 = sphere.radius * sphere.radius;
    BRUME_PRECISE float a = dotReplayable(way, way);
    BRUME_PRECISE float b = dotReplayable(m, way);
    BRUME_PRECISE float c = dotReplayable(m, m) - radius2;
    // Through the part of m across the way: b^2 - a c would lose the digits of small spheres.
    BRUME_PRECISE vec3 across = m - way * (b * reciprocalReplayable(a > 0.0f ? a : 1.0f));
    BRUME_PRECISE float room = a * (radius2 - dotReplayable(across, across));
    BRUME_PRECISE float root = sqrtReplayable(room > 0.0f ? room : 0.0f);

    bool isHollow = sphere.isHollow != 0u;
    bool endsInside = dotReplayable(n, n) < radius2;
    // Solid: enters from outside, or starts within rounding inside and does not leave.
    bool enters = c >= 0.0f ? b < 0.0f && room > 0.0f : b < 0.0f || endsInside;
    BRUME_PRECISE float entry =
        c > 0.0f ? c * reciprocalReplayable(root - b > 0.0f ? root - b : 1.0f) : 0.0f;
    // Hollow: ends outside.
    BRUME_PRECISE float exit =
        c < 0.0f ? (root - b) * reciprocalReplayable(a > 0.0f ? a : 1.0f) : 0.0f;
    BRUME_PRECISE float time = isHollow ? exit : entry;
    time = time < 1.0f || !isHollow ? time : 1.0f;

    BRUME_PRECISE vec3 place = m + way * time;
    BRUME_PRECISE vec3 normal = directionReplayable(place, vec3(0.0f, 1.0f, 0.0f));
    BRUME_PRECISE vec3 surfacePlace = sphere.center + normal * sphere.radius;
    keepEarlier(hit, (isHollow ? !endsInside : enters) && time <= 1.0f, time, surfacePlace,
                isHollow ? -normal : normal, sphere.surface);
}

BRUME_STRUCTS_END
#endif
