// SPDX-License-Identifier: Apache-2.0
// How a particle looks at its age: piecewise-linear curves of radius, density and tint; and how few
// of them are enough far away.
//
// Thinning: each particle has a rank in [0, 1), drawn by its birth, and is there as far as its rank is
// below an edge e that falls with the distance: kept(rank) = clamp((e - rank) / (e / 4), 0, 1). Its
// density fades by that, so that nothing pops. With s the mean of kept over all ranks, those kept
// have 1 / sqrt(s) times the radius and sqrt(s) times the density: each hides as much as before where
// it is, over 1 / s times the area, so that optical depth and transmittance are kept in expectation.
// Limits: a cloud grows by what its particles' radii do.
#ifndef BRUME_SHADERS_PARTICLES_APPEARANCE_H
#define BRUME_SHADERS_PARTICLES_APPEARANCE_H

#include "step.h"

BRUME_STRUCTS_BEGIN

struct Appearance {
    float radius;   // m, effect space
    float density;  // multiplies the medium's extinction
    vec3 tint;
};

/// The part of a segment that lies below x.
BRUME_SHARED float partBelow(float x, float start, float width) {
    float part = x - start;
    part = part > 0.0f ? part : 0.0f;
    return part < width ? part : width;
}

/// The curves at normalised age and speed in m/s; values are never negative.
BRUME_SHARED Appearance evaluateAppearance(BRUME_EFFECT_PARAMETER float age, float speed) {
    float radius = BRUME_EFFECT.appearance.radius;
    float density = BRUME_EFFECT.appearance.density;
    vec3 tint = BRUME_EFFECT.appearance.tint;
    for (uint i = 0u; i < BRUME_EFFECT.appearance.segmentCount; ++i) {
        AppearanceSegment segment = BRUME_EFFECT.appearance.segments[i];
        float part = partBelow(age, segment.start, segment.width);
        radius = radius + segment.radiusSlope * part;
        density = density + segment.densitySlope * part;
        tint = tint + segment.tintSlope * part;
    }
    float radiusFactor = BRUME_EFFECT.appearance.radiusFactor;
    float densityFactor = BRUME_EFFECT.appearance.densityFactor;
    for (uint i = 0u; i < BRUME_EFFECT.appearance.speedSegmentCount; ++i) {
        SpeedSegment segment = BRUME_EFFECT.appearance.speedSegments[i];
        float part = partBelow(speed, segment.start, segment.width);
        radiusFactor = radiusFactor + segment.radiusSlope * part;
        densityFactor = densityFactor + segment.densitySlope * part;
    }
    radius = radius * radiusFactor;
    density = density * densityFactor;
    Appearance appearance;
    appearance.radius = radius > 0.0f ? radius : 0.0f;
    appearance.density = density > 0.0f ? density : 0.0f;
    appearance.tint = vec3(tint.x > 0.0f ? tint.x : 0.0f, tint.y > 0.0f ? tint.y : 0.0f,
                           tint.z > 0.0f ? tint.z : 0.0f);
    return appearance;
}

/// The edge of the ranks that are kept at a distance in metres; all of them up to thinningDistance.
BRUME_SHARED float thinningEdge(BRUME_EFFECT_PARAMETER float distance) {
    float near = BRUME_EFFECT.appearance.thinningDistance;
    float part = distance > near ? near / distance : 1.0f;
    float edge = 1.3333334f * part * part;
    float least = BRUME_EFFECT.appearance.thinningLeast * 1.1428572f;
    return edge > least ? edge : least;
}

/// The mean of keptPart() over all ranks.
BRUME_SHARED float keptShare(float edge) {
    float beyond = edge - 1.0f;
    float share = edge > 1.0f ? 0.75f * edge + (0.0625f * edge * edge - beyond * beyond) /
                                                   (0.5f * edge)
                              : 0.875f * edge;
    return share < 1.0f ? share : 1.0f;
}

/// How much of a particle of that rank is there.
BRUME_SHARED float keptPart(float edge, float rank) {
    return partBelow((edge - rank) / (0.25f * edge), 0.0f, 1.0f);
}

BRUME_SHARED float thinningRank(RandomStream random, uint birthIndex) {
    return unitFloat(randomWords(random, birthIndex, kChannelLook).z);
}

/// The look at a distance in metres.
BRUME_SHARED Appearance thinOut(BRUME_EFFECT_PARAMETER Appearance look, float distance,
                                float rank) {
    float edge = thinningEdge(BRUME_EFFECT_ARGUMENT distance);
    float part = keptPart(edge, rank);
    float root = sqrtReplayable(keptShare(edge));
    Appearance thinned = look;
    thinned.radius = part > 0.0f ? look.radius / root : 0.0f;
    thinned.density = look.density * part * root;
    return thinned;
}

/// Age over lifetime, `sinceTick` (below 1) ticks after the end of `tick`.
BRUME_SHARED float normalisedAge(ParticleLife life, uint tick, float sinceTick) {
    return life.lifetimeTicks > 0.0f ? (ageTicks(life, tick) + sinceTick) / life.lifetimeTicks
                                     : 1.0f;
}

/// Neither killed nor, since the last tick, too old.
BRUME_SHARED bool isShownAt(ParticleLife life, uint tick, float sinceTick) {
    bool isOld = sinceTick > 0.0f && ageTicks(life, tick) + sinceTick >= life.lifetimeTicks;
    return life.lifetimeTicks >= 0.0f && !isOld;
}

BRUME_STRUCTS_END
#endif
