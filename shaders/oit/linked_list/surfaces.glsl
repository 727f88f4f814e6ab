// SPDX-License-Identifier: Apache-2.0
// Crossing the surfaces of a list. The includer defines kSolids: there are solids.
#ifndef BRUME_OIT_LINKED_LIST_SURFACES_GLSL
#define BRUME_OIT_LINKED_LIST_SURFACES_GLSL
#include "../integrate/path.glsl"
#include "lists.h"

void crossSurface(inout Path path, vec3 radiance, vec3 loss) {
    path.radiance += path.surfaces * path.decay * radiance;
    // Thousands of faint layers: 1 - alpha rounds the same way each time, the loss does not.
    addExactly(path.surfaces, path.surfacesLo, -(path.surfaces + path.surfacesLo) * loss);
}

// A thin surface, or one side of a solid.
void crossSurface(inout Path path, inout Sums solids, SolidRecord record) {
    crossSurface(path, record.surface.radiance, record.surface.loss);
    if (kSolids && record.face != kFaceThin)
        addToSums(solids, record.face == kFaceFront ? 1.0 : -1.0, record.extinction,
                  record.scattering);
}

#endif
