// SPDX-License-Identifier: Apache-2.0
// Air that circles around a line.
// Source: Kaufmann, "Über die Ausbreitung kreiszylindrischer Wirbel in zähen Flüssigkeiten",
// Ingenieur-Archiv 31, 1962, 10.1007/BF00538235 (also called the Scully vortex). Equations: speed
// around the axis Gamma r / (2 pi (r^2 + core^2)), so that the circulation of a circle of radius r
// is Gamma r^2 / (r^2 + core^2).
#ifndef BRUME_SHADERS_PARTICLES_MODULES_VORTEX_H
#define BRUME_SHADERS_PARTICLES_MODULES_VORTEX_H

#include "../../common/replayable_math.h"

BRUME_STRUCTS_BEGIN

struct Vortex {
    vec3 center;       // a point of the axis, m
    float weight;      // share of its drag rate in that of the effect
    vec3 axis;         // unit; counter-clockwise around it
    float strength;    // Gamma / (2 pi), m^2/s
    float core2;       // core radius squared, m^2
    float inflow;      // speed towards the axis per speed around it
    float updraft;     // speed along the axis per speed around it
    float halfLength;  // half the length along the axis, m; beyond it there is no wind
};

/// Velocity of the air, m/s.
BRUME_SHARED vec3 vortexVelocity(Vortex vortex, vec3 position) {
    BRUME_PRECISE vec3 d = position - vortex.center;
    BRUME_PRECISE float along = dotReplayable(d, vortex.axis);
    BRUME_PRECISE vec3 radial = d - vortex.axis * along;
    BRUME_PRECISE float r2 = dotReplayable(radial, radial);
    BRUME_PRECISE float turn = vortex.strength * reciprocalReplayable(r2 + vortex.core2);
    // Speed around the axis is turn * r: its shares along the axis need r itself.
    BRUME_PRECISE vec3 velocity =
        (crossReplayable(vortex.axis, radial) - radial * vortex.inflow) * turn +
        vortex.axis * (vortex.updraft * turn * sqrtReplayable(r2));
    bool isInside = along <= vortex.halfLength && -along <= vortex.halfLength;
    return isInside ? velocity : vec3(0.0f);
}

BRUME_STRUCTS_END
#endif
