// SPDX-License-Identifier: Apache-2.0
// Acceleration towards a point or a line.
// Equations: a = strength (reference / rho)^falloff along d / rho, with d the way to the centre and
// rho^2 = |d|^2 + core^2 (Plummer softening), falloff -1 (spring), 0, 1 or 2 (gravitation).
// Source: Plummer, "On the problem of distribution in globular star clusters", MNRAS 71, 1911.
#ifndef BRUME_SHADERS_PARTICLES_MODULES_ATTRACTOR_H
#define BRUME_SHADERS_PARTICLES_MODULES_ATTRACTOR_H

#include "../../common/replayable_math.h"

BRUME_STRUCTS_BEGIN

struct Attractor {
    vec3 center;     // m
    float strength;  // strength * reference^falloff; negative pushes away
    vec3 axis;       // unit: the attractor is the line along it; zero: the point
    float core2;     // softening radius squared, m^2
    uint power;      // falloff + 1
    float kill;      // radius around the centre in which particles die, m; 0: none
};

/// The way from `position` to the attractor.
BRUME_SHARED vec3 attractorOffset(Attractor attractor, vec3 position) {
    BRUME_PRECISE vec3 d = attractor.center - position;
    d = d - attractor.axis * dotReplayable(d, attractor.axis);
    return d;
}

/// m/s^2.
BRUME_SHARED vec3 attractorAcceleration(Attractor attractor, vec3 position) {
    BRUME_PRECISE vec3 d = attractorOffset(attractor, position);
    BRUME_PRECISE float rho2 = dotReplayable(d, d) + attractor.core2;
    bool isCentre = rho2 < 1e-24f;
    BRUME_PRECISE float rho = sqrtReplayable(isCentre ? 1.0f : rho2);
    BRUME_PRECISE float inverse = reciprocalReplayable(rho);
    BRUME_PRECISE float fall = attractor.strength;
    for (uint i = 0u; i < attractor.power; ++i) fall = fall * inverse;
    BRUME_PRECISE vec3 acceleration = d * fall;
    return isCentre ? vec3(0.0f) : acceleration;
}

/// Whether the way from `start` to `end` comes into the attractor's kill radius.
BRUME_SHARED bool attractorSwallows(Attractor attractor, vec3 start, vec3 end) {
    BRUME_PRECISE vec3 a = attractorOffset(attractor, start);
    BRUME_PRECISE vec3 way = a - attractorOffset(attractor, end);
    BRUME_PRECISE float length2 = dotReplayable(way, way);
    BRUME_PRECISE float part = dotReplayable(a, way);
    part = part > 0.0f ? part : 0.0f;
    part = part < length2 ? part * reciprocalReplayable(length2 > 0.0f ? length2 : 1.0f) : 1.0f;
    BRUME_PRECISE vec3 nearest = a - way * part;
    BRUME_PRECISE float kill2 = attractor.kill * attractor.kill;
    return dotReplayable(nearest, nearest) < kill2;
}

BRUME_STRUCTS_END
#endif
