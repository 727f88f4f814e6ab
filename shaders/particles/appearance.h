// SPDX-License-Identifier: Apache-2.0
// How a particle looks at its age: piecewise-linear curves of radius, density and tint.
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
