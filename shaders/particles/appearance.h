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

/// The curves at normalised age; values are never negative.
BRUME_SHARED Appearance evaluateAppearance(BRUME_EFFECT_PARAMETER float age) {
    BRUME_PRECISE float radius = BRUME_EFFECT.appearance.radius;
    BRUME_PRECISE float density = BRUME_EFFECT.appearance.density;
    BRUME_PRECISE vec3 tint = BRUME_EFFECT.appearance.tint;
    for (uint i = 0u; i < BRUME_EFFECT.appearance.segmentCount; ++i) {
        AppearanceSegment segment = BRUME_EFFECT.appearance.segments[i];
        BRUME_PRECISE float part = age - segment.start;
        part = part > 0.0f ? part : 0.0f;
        part = part < segment.width ? part : segment.width;
        radius = radius + segment.radiusSlope * part;
        density = density + segment.densitySlope * part;
        tint = tint + segment.tintSlope * part;
    }
    Appearance appearance;
    appearance.radius = radius > 0.0f ? radius : 0.0f;
    appearance.density = density > 0.0f ? density : 0.0f;
    appearance.tint = vec3(tint.x > 0.0f ? tint.x : 0.0f, tint.y > 0.0f ? tint.y : 0.0f,
                           tint.z > 0.0f ? tint.z : 0.0f);
    return appearance;
}

/// Age over lifetime at the end of `tick`.
BRUME_SHARED float normalisedAge(ParticleLife life, uint tick) {
    return life.lifetimeTicks > 0.0f ? ageTicks(life, tick) / life.lifetimeTicks : 1.0f;
}

BRUME_STRUCTS_END
#endif
