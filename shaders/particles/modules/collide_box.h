// SPDX-License-Identifier: Apache-2.0
// A box of any orientation that particles cannot enter, or cannot leave. Limits: for particles with
// a radius the box grows by it with sharp corners.
#ifndef BRUME_SHADERS_PARTICLES_MODULES_COLLIDE_BOX_H
#define BRUME_SHADERS_PARTICLES_MODULES_COLLIDE_BOX_H

#include "../contact.h"

BRUME_STRUCTS_BEGIN

struct BoxCollider {
    vec3 center;  // m
    vec3 axisX;   // unit, orthogonal
    vec3 axisY;
    vec3 axisZ;
    vec3 extent;  // half edge lengths, that of the particles' radius included, m
    uint isHollow;  // particles stay inside
    ContactSurface surface;
};

/// One pair of faces, along one axis of the box.
struct Slab {
    float enter;  // part of the way at which it is entered and left
    float leave;
    float depth;  // of the start inside, m; negative outside
    float side;   // of the face that is nearest to the start, 1 or -1
    float entrySide;
};

BRUME_SHARED Slab sweepSlab(float start, float way, float extent) {
    Slab slab;
    bool isParallel = way < 1e-20f && way > -1e-20f;
    BRUME_PRECISE float inverse = reciprocalReplayable(isParallel ? 1.0f : way);
    BRUME_PRECISE float sign = way < 0.0f ? -1.0f : 1.0f;
    BRUME_PRECISE float enter = (sign * -extent - start) * inverse;
    BRUME_PRECISE float leave = (sign * extent - start) * inverse;
    BRUME_PRECISE float size = start < 0.0f ? -start : start;
    bool isOutside = size > extent;
    slab.enter = isParallel ? (isOutside ? 2.0f : -1e30f) : enter;
    slab.leave = isParallel ? (isOutside ? -1.0f : 1e30f) : leave;
    BRUME_PRECISE float depth = extent - size;
    slab.depth = depth;
    slab.side = start < 0.0f ? -1.0f : 1.0f;
    slab.entrySide = -sign;
    return slab;
}

BRUME_SHARED void sweepBox(BoxCollider box, vec3 start, vec3 end, BRUME_INOUT(Hit) hit) {
    BRUME_PRECISE vec3 m = start - box.center;
    BRUME_PRECISE vec3 way = end - start;
    BRUME_PRECISE vec3 p = vec3(dotReplayable(m, box.axisX), dotReplayable(m, box.axisY),
                                dotReplayable(m, box.axisZ));
    BRUME_PRECISE vec3 d = vec3(dotReplayable(way, box.axisX), dotReplayable(way, box.axisY),
                                dotReplayable(way, box.axisZ));
    Slab x = sweepSlab(p.x, d.x, box.extent.x);
    Slab y = sweepSlab(p.y, d.y, box.extent.y);
    Slab z = sweepSlab(p.z, d.z, box.extent.z);

    bool isHollow = box.isHollow != 0u;
    bool startsInside = x.depth > 0.0f && y.depth > 0.0f && z.depth > 0.0f;
    BRUME_PRECISE float enter = x.enter > y.enter ? x.enter : y.enter;
    enter = enter > z.enter ? enter : z.enter;
    BRUME_PRECISE float leave = x.leave < y.leave ? x.leave : y.leave;
    leave = leave < z.leave ? leave : z.leave;

    // The face: nearest to a start inside a solid box (or outermost to one outside a hollow one),
    // else the one through which the way goes.
    bool isNearest = startsInside != isHollow;
    uint face = isHollow ? (leave == x.leave   ? 0u
                            : leave == y.leave ? 1u
                                               : 2u)
                         : (enter == x.enter   ? 0u
                            : enter == y.enter ? 1u
                                               : 2u);
    uint nearest = x.depth <= y.depth && x.depth <= z.depth ? 0u : y.depth <= z.depth ? 1u : 2u;
    face = isNearest ? nearest : face;
    BRUME_PRECISE float throughSide = face == 0u   ? x.entrySide
                                      : face == 1u ? y.entrySide
                                                   : z.entrySide;
    BRUME_PRECISE float nearSide = face == 0u ? x.side : face == 1u ? y.side : z.side;
    BRUME_PRECISE float side = isNearest ? nearSide : isHollow ? -throughSide : throughSide;
    BRUME_PRECISE float speed = (face == 0u ? d.x : face == 1u ? d.y : d.z) * side;

    // Inside a solid box: hit unless the way leads out through the nearest face.
    BRUME_PRECISE float depth = face == 0u ? x.depth : face == 1u ? y.depth : z.depth;
    bool isHit = isHollow ? leave <= 1.0f || !startsInside
                 : startsInside ? speed < 0.0f || speed < depth
                                : enter <= leave && enter >= 0.0f && enter <= 1.0f;
    BRUME_PRECISE float time = isNearest ? 0.0f : isHollow ? leave : enter;
    time = time > 0.0f ? time : 0.0f;

    BRUME_PRECISE vec3 q = p + d * time;
    BRUME_PRECISE vec3 e = box.extent;
    // A hollow box takes back what has got out in more than one direction.
    q = vec3(isHollow && q.x > e.x ? e.x : isHollow && q.x < -e.x ? -e.x : q.x,
             isHollow && q.y > e.y ? e.y : isHollow && q.y < -e.y ? -e.y : q.y,
             isHollow && q.z > e.z ? e.z : isHollow && q.z < -e.z ? -e.z : q.z);
    q = vec3(face == 0u ? side * e.x : q.x, face == 1u ? side * e.y : q.y,
             face == 2u ? side * e.z : q.z);
    BRUME_PRECISE vec3 place = box.center + box.axisX * q.x + box.axisY * q.y + box.axisZ * q.z;
    BRUME_PRECISE vec3 outward =
        (face == 0u ? box.axisX : face == 1u ? box.axisY : box.axisZ) * side;
    keepEarlier(hit, isHit, time, place, isHollow ? -outward : outward, box.surface);
}

BRUME_STRUCTS_END
#endif
