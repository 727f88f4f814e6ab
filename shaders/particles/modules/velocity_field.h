// SPDX-License-Identifier: Apache-2.0
// Air that moves as a grid of velocities says: carries particles along, or drags them.
// Equations: advection adds u(x) to dx/dt and is followed by the midpoint rule, second order in the
// tick: x += u(x + (v + u(x)) h/2) h. Limits: outside its box the air is at rest; a particle's own
// velocity does not contain what carries it, so that a bounce turns only its own.
#ifndef BRUME_SHADERS_PARTICLES_MODULES_VELOCITY_FIELD_H
#define BRUME_SHADERS_PARTICLES_MODULES_VELOCITY_FIELD_H

#include "../field_grid.h"

BRUME_STRUCTS_BEGIN

struct VelocityField {
    FieldGrid grid;
    float strength;  // of its values
    float weight;    // its share in the drag of the effect; 0: advects
    uint advects;
};

/// m/s.
BRUME_SHARED vec3 velocityFieldAt(BRUME_FIELDS_PARAMETER VelocityField field, vec3 position) {
    BRUME_PRECISE vec3 velocity =
        sampleVectorField(BRUME_FIELDS_ARGUMENT field.grid, position) * field.strength;
    return velocity;
}

BRUME_STRUCTS_END
#endif
