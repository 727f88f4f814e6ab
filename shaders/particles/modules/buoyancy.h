// SPDX-License-Identifier: Apache-2.0
// Lift in proportion to how much warmer than its surroundings the air is at a place.
// Equations: a = lift (T - ambient), Boussinesq's approximation with lift = -g / ambient.
#ifndef BRUME_SHADERS_PARTICLES_MODULES_BUOYANCY_H
#define BRUME_SHADERS_PARTICLES_MODULES_BUOYANCY_H

#include "../field_grid.h"

BRUME_STRUCTS_BEGIN

struct Buoyancy {
    FieldGrid grid;  // outside its box: the ambient temperature
    vec3 lift;       // m/s^2 per unit of temperature
    float ambient;
};

/// m/s^2.
BRUME_SHARED vec3 buoyancyAcceleration(BRUME_FIELDS_PARAMETER Buoyancy buoyancy, vec3 position) {
    BRUME_PRECISE float excess =
        sampleScalarField(BRUME_FIELDS_ARGUMENT buoyancy.grid, position) - buoyancy.ambient;
    BRUME_PRECISE vec3 acceleration = buoyancy.lift * excess;
    return acceleration;
}

BRUME_STRUCTS_END
#endif
