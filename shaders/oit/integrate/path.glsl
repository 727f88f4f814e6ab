// SPDX-License-Identifier: Apache-2.0
// Crossing one medium after another along a ray, front to back. The includer defines kColoured:
// extinction differs between channels.
#ifndef BRUME_OIT_INTEGRATE_PATH_GLSL
#define BRUME_OIT_INTEGRATE_PATH_GLSL
#include "../../common/exponential.glsl"
#include "path.h"

Path beginPath() { return Path(vec3(0), vec3(1), vec3(0), vec3(0), vec3(0), vec3(1)); }
Sums noSums() { return Sums(0, vec3(0), vec3(0), vec3(0), vec3(0)); }

vec3 expChannels(vec3 x) { return kColoured ? exp(x) : vec3(exp(x.x)); }

// One more (sign = 1) or less (-1). In free space the sums are set to zero: what rounding has left
// must not reach the background.
void addToSums(inout Sums sums, float sign, vec3 extinction, vec3 source) {
    sums.count += sign > 0.0 ? 1 : -1;
    addExactly(sums.extinctionHi, sums.extinctionLo, sign * extinction);
    addExactly(sums.sourceHi, sums.sourceLo, sign * source);
    if (sums.count <= 0) sums = Sums(sums.count, vec3(0), vec3(0), vec3(0), vec3(0));
}

void addDepth(inout Path path, vec3 depth) {
    addExactly(path.depthHi, path.depthLo, depth);
    path.decay = expChannels(-(path.depthHi + path.depthLo));
}

// A stretch in which extinction and source (radiance per metre) are constant.
void crossConstant(inout Path path, vec3 extinction, vec3 source, float distance) {
    // No difference behind a depth of 1e30, but sums stay finite.
    vec3 depth = min(extinction * distance, vec3(1e30));
    vec3 decay = expChannels(-depth);
    vec3 before = path.surfaces * path.decay;
    // Divide by the extinction first where the stretch is long: source * distance may overflow.
    vec3 thin = source * (distance * meanDecay(depth, decay));
    vec3 thick = source / max(extinction, vec3(1e-30)) * (1.0 - decay);
    path.radiance += before * mix(thick, thin, lessThan(depth, vec3(0.1)));
    addDepth(path, depth);
}

#endif
