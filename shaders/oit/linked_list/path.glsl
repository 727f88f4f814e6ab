// SPDX-License-Identifier: Apache-2.0
// What a ray has met so far: everything that compositing front to back carries along.
#ifndef BRUME_OIT_LINKED_LIST_PATH_GLSL
#define BRUME_OIT_LINKED_LIST_PATH_GLSL
#include "../../common/exponential.glsl"
#include "lists.h"

struct Path {
    vec3 radiance;
    vec3 surfaces;  // product of the transmissions of the thin surfaces crossed
    vec3 depthHi,
        depthLo;  // optical depth of the media crossed, compensated: T = surfaces * exp(-depth)
    vec3 decay;   // exp(-depth)
};

// The solids that the ray is inside: constant media.
struct Solids {
    int count;
    vec3 extinctionHi, extinctionLo;
    vec3 scatteringHi, scatteringLo;
};

Path beginPath() { return Path(vec3(0), vec3(1), vec3(0), vec3(0), vec3(1)); }
Solids noSolids() { return Solids(0, vec3(0), vec3(0), vec3(0), vec3(0)); }

vec3 expChannels(vec3 x) { return kColoured ? exp(x) : vec3(exp(x.x)); }

void addDepth(inout Path path, vec3 depth) {
    addExactly(path.depthHi, path.depthLo, depth);
    path.decay = expChannels(-(path.depthHi + path.depthLo));
}

// A stretch in which extinction and source (radiance per metre) are constant.
void crossConstant(inout Path path, vec3 extinction, vec3 source, float distance) {
    vec3 depth = extinction * distance;
    vec3 decay = expChannels(-depth);
    vec3 before = path.surfaces * path.decay;
    // Divide by the extinction first where the stretch is long: source * distance may overflow.
    vec3 thin = source * (distance * meanDecay(depth, decay));
    vec3 thick = source / max(extinction, vec3(1e-30)) * (1.0 - decay);
    path.radiance += before * mix(thick, thin, lessThan(depth, vec3(0.1)));
    addDepth(path, depth);
}

void crossThin(inout Path path, SurfaceRecord record) {
    path.radiance += path.surfaces * path.decay * (record.coverage * record.radiance);
    path.surfaces *= 1.0 - record.coverage + record.coverage * record.transmission;
}

void crossSolid(inout Solids solids, SurfaceRecord record) {
    float sign = record.face == kFaceFront ? 1.0 : -1.0;
    solids.count += record.face == kFaceFront ? 1 : -1;
    addExactly(solids.extinctionHi, solids.extinctionLo, sign * record.transmission);
    addExactly(solids.scatteringHi, solids.scatteringLo, sign * record.scattering);
    // Free space again: what rounding has left must not reach the background.
    if (solids.count <= 0) solids = Solids(solids.count, vec3(0), vec3(0), vec3(0), vec3(0));
}

bool isOpaque(Path path) {
    vec3 rest = path.surfaces * path.decay;
    return max(rest.x, max(rest.y, rest.z)) < 1e-20;
}

#endif
