// SPDX-License-Identifier: Apache-2.0
// Crossing the surfaces of a list.
#ifndef BRUME_OIT_LINKED_LIST_SURFACES_GLSL
#define BRUME_OIT_LINKED_LIST_SURFACES_GLSL
#include "../integrate/path.glsl"
#include "lists.h"

// A thin surface, or one side of a solid.
void crossSurface(inout Path path, inout Sums solids, SurfaceRecord record) {
    if (record.face == kFaceThin) {
        path.radiance += path.surfaces * path.decay * (record.coverage * record.radiance);
        // Thousands of faint layers: 1 - alpha rounds the same way each time, the loss does not.
        vec3 loss = record.coverage * (1.0 - record.transmission);
        addExactly(path.surfaces, path.surfacesLo, -(path.surfaces + path.surfacesLo) * loss);
    } else {
        path.radiance += path.surfaces * path.decay * record.radiance;
        addExactly(path.surfaces, path.surfacesLo,
                   -(path.surfaces + path.surfacesLo) * record.coverage);
        addToSums(solids, record.face == kFaceFront ? 1.0 : -1.0, record.transmission,
                  record.scattering);
    }
}

#endif
