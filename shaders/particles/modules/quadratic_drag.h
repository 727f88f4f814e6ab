// SPDX-License-Identifier: Apache-2.0
// Drag that grows with the square of the speed through the air, as of anything larger than dust.
// Equations: dv/dt = -c |v - w| (v - w) has the exact solution s(h) = s / (1 + c |s| h) of the slip
// s = v - w. The step takes half a tick of it before and after the exact step of all else
// (Strang, "On the construction and comparison of difference schemes", SIAM J. Numer. Anal. 5,
// 1968): second order in h, stable at any h.
#ifndef BRUME_SHADERS_PARTICLES_MODULES_QUADRATIC_DRAG_H
#define BRUME_SHADERS_PARTICLES_MODULES_QUADRATIC_DRAG_H

#include "../../common/replayable_math.h"

BRUME_STRUCTS_BEGIN

struct QuadraticDrag {
    vec3 wind;          // m/s
    float coefficient;  // 1/m
};

/// The velocity after `seconds` of this drag alone.
BRUME_SHARED vec3 quadraticDragVelocity(QuadraticDrag drag, vec3 velocity, float seconds) {
    BRUME_PRECISE vec3 slip = velocity - drag.wind;
    BRUME_PRECISE float y = drag.coefficient * seconds * lengthReplayable(slip);
    BRUME_PRECISE float loss = y * reciprocalReplayable(1.0f + y);
    // The loss, not 1 - loss, multiplies: it keeps its digits over many short ticks.
    BRUME_PRECISE vec3 slowed = velocity - slip * loss;
    return slowed;
}

BRUME_STRUCTS_END
#endif
