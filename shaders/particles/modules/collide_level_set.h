// SPDX-License-Identifier: Apache-2.0
// A solid given by a grid of signed distances, which particles cannot enter.
// Source: sphere tracing, Hart, "Sphere tracing: a geometric method for the antialiased ray tracing
// of implicit surfaces", The Visual Computer 12, 1996, 10.1007/s003710050084. Differs: steps are at
// least half a voxel long, and the place of the hit is bisected. Limits: walls thinner than half a
// voxel; where the way through the grid is longer than the steps allow, the particle waits there for
// the next tick.
#ifndef BRUME_SHADERS_PARTICLES_MODULES_COLLIDE_LEVEL_SET_H
#define BRUME_SHADERS_PARTICLES_MODULES_COLLIDE_LEVEL_SET_H

#include "../contact.h"
#include "../field_grid.h"

BRUME_STRUCTS_BEGIN

BRUME_CONST uint kMaxLevelSetSteps = 96u;
BRUME_CONST uint kLevelSetBisections = 8u;

struct LevelSetCollider {
    FieldGrid grid;
    float scale;      // of its values: m per unit
    float radius;     // of the particles, m
    float leastStep;  // half a voxel, m
    ContactSurface surface;
};

/// Distance of a particle's skin from the surface, m; negative inside.
BRUME_SHARED float levelSetDistance(BRUME_FIELDS_PARAMETER LevelSetCollider solid,
                                    vec3 position) {
    BRUME_PRECISE float distance =
        sampleScalarField(BRUME_FIELDS_ARGUMENT solid.grid, position) * solid.scale -
        solid.radius;
    return distance;
}

/// Narrows the part [range.x, range.y] of a way to where -1 < start + way t < size, one axis.
BRUME_SHARED vec2 clipLevelSetAxis(vec2 range, float start, float way, float size) {
    bool isParallel = way < 1e-12f && way > -1e-12f;
    BRUME_PRECISE float inverse = reciprocalReplayable(isParallel ? 1.0f : way);
    BRUME_PRECISE float a = (-1.0f - start) * inverse;
    BRUME_PRECISE float b = (size - start) * inverse;
    BRUME_PRECISE float low = a < b ? a : b;
    BRUME_PRECISE float high = a < b ? b : a;
    bool isOutside = start <= -1.0f || start >= size;
    low = isParallel ? (isOutside ? 2.0f : 0.0f) : low;
    high = isParallel ? 1.0f : high;
    return vec2(low > range.x ? low : range.x, high < range.y ? high : range.y);
}

/// Where along a way that begins outside the solid the solid begins.
struct LevelSetTrace {
    float time;      // part of the way, outside the solid still
    uint isHit;
    uint isStopped;  // out of steps
};

BRUME_SHARED LevelSetTrace traceLevelSet(BRUME_FIELDS_PARAMETER LevelSetCollider solid, vec3 start,
                                         vec3 way, vec2 range, float distanceAtStart) {
    LevelSetTrace trace;
    trace.time = range.x;
    trace.isHit = 0u;
    trace.isStopped = 1u;
    BRUME_PRECISE float inverse = reciprocalReplayable(lengthReplayable(way));
    BRUME_PRECISE float least = solid.leastStep * inverse;
    BRUME_PRECISE float time = range.x;
    BRUME_PRECISE float beyond = range.x;
    BRUME_PRECISE float distance = distanceAtStart;
    for (uint i = 0u; i < kMaxLevelSetSteps; ++i) {
        BRUME_PRECISE float step = distance * inverse;
        beyond = time + (step > least ? step : least);
        beyond = beyond < range.y ? beyond : range.y;
        BRUME_PRECISE vec3 place = start + way * beyond;
        distance = levelSetDistance(BRUME_FIELDS_ARGUMENT solid, place);
        if (distance < 0.0f) {
            trace.isHit = 1u;
            break;
        }
        time = beyond;
        if (beyond >= range.y) {
            trace.isStopped = 0u;
            break;
        }
    }
    if (trace.isHit != 0u) {
        for (uint i = 0u; i < kLevelSetBisections; ++i) {
            BRUME_PRECISE float middle = 0.5f * (time + beyond);
            BRUME_PRECISE vec3 place = start + way * middle;
            bool isInside = levelSetDistance(BRUME_FIELDS_ARGUMENT solid, place) < 0.0f;
            beyond = isInside ? middle : beyond;
            time = isInside ? time : middle;
        }
        trace.isStopped = 0u;
    }
    trace.time = time;
    return trace;
}

BRUME_SHARED void sweepLevelSet(BRUME_FIELDS_PARAMETER LevelSetCollider solid, vec3 start,
                                vec3 end, BRUME_INOUT(Hit) hit) {
    BRUME_PRECISE vec3 way = end - start;
    BRUME_PRECISE vec3 index = fieldIndex(solid.grid, start);
    BRUME_PRECISE vec3 indexWay = fieldIndex(solid.grid, end) - index;
    vec2 range = vec2(0.0f, 1.0f);
    range = clipLevelSetAxis(range, index.x, indexWay.x, float(solid.grid.size.x));
    range = clipLevelSetAxis(range, index.y, indexWay.y, float(solid.grid.size.y));
    range = clipLevelSetAxis(range, index.z, indexWay.z, float(solid.grid.size.z));
    if (!(range.x <= range.y)) return;

    BRUME_PRECISE vec3 entry = start + way * range.x;
    BRUME_PRECISE float distance = levelSetDistance(BRUME_FIELDS_ARGUMENT solid, entry);
    bool startsInside = distance < 0.0f;
    LevelSetTrace trace;
    trace.time = range.x;
    trace.isHit = 1u;
    trace.isStopped = 0u;
    bool moves = dotReplayable(way, way) > 1e-24f;
    if (!startsInside && !moves) return;
    if (!startsInside)
        trace = traceLevelSet(BRUME_FIELDS_ARGUMENT solid, start, way, range, distance);

    BRUME_PRECISE vec3 place = start + way * trace.time;
    vec3 normal = directionReplayable(fieldGradient(BRUME_FIELDS_ARGUMENT solid.grid, place),
                                      vec3(0.0f, 1.0f, 0.0f));
    // From inside: pushed out, unless it leaves by itself.
    bool leaves = startsInside && dotReplayable(way, normal) >= 0.0f &&
                  levelSetDistance(BRUME_FIELDS_ARGUMENT solid, end) >= 0.0f;
    if (startsInside) {
        BRUME_PRECISE vec3 surfacePlace = place - normal * distance;
        place = surfacePlace;
    }
    ContactSurface surface = solid.surface;
    if (trace.isStopped != 0u) surface.response = kResponseWait;
    keepEarlier(hit, !leaves && (trace.isHit != 0u || trace.isStopped != 0u), trace.time, place,
                normal, surface);
}

BRUME_STRUCTS_END
#endif
