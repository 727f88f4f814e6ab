// SPDX-License-Identifier: Apache-2.0
// One step through one medium in light that is linear along it. By parts, the radiance gained is
// S(0) (1 - exp(-D)) + (S(1) - S(0)) (I - exp(-D)), with the optical depth D of the step and the mean
// I of exp(-depth) along it: only I is left to Gauss's rule, with three points.
#ifndef BRUME_OIT_INTEGRATE_LINEAR_LIGHT_GLSL
#define BRUME_OIT_INTEGRATE_LINEAR_LIGHT_GLSL
#include "quadrature.glsl"

const vec3 kLinearNodes = vec3(0.1127016653792583, 0.5, 0.8872983346207417);
const vec3 kLinearWeights = vec3(5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0);
// Integrals of the node polynomials up to each node: exact for densities of degree two, while those
// of cells have three; what that leaves is multiplied by the change of the light.
const vec3 kUpToFirst = vec3(0.1388888888888889, -0.0359766675249389, 0.0097894440153083);
const vec3 kUpToSecond = vec3(0.3002631949808646, 0.2222222222222222, -0.0224854172030868);
const vec3 kUpToThird = vec3(0.2679883337624694, 0.4804211119693833, 0.1388888888888889);
// Error of I by depth: the rule's is depth^6 / 2 016 000 for a constant density; we allow for more.
const float kErrorOfMean = 1e-6;

// `density`: at the nodes; `early`, `late`: radiance that is scattered at both ends per unit of optical
// depth. Returns the estimated error in units of what is allowed; above 1 nothing is done.
float crossLinear(inout Path path, MediumData medium, vec3 density, vec3 early, vec3 late,
                  float distance) {
    vec3 extinction = kColoured ? medium.extinction : medium.extinction.xxx;
    float sum = dot(density, kLinearWeights) * distance;
    vec3 depth = min(extinction * sum, vec3(1e30));
    vec3 before = path.surfaces * path.decay;
    vec3 change = medium.albedo * (late - early);
    vec3 depth2 = depth * depth;
    vec3 error = before * abs(change) * min(kErrorOfMean * depth2 * depth2 * depth2, vec3(1));
    float worst = max(error.x, max(error.y, error.z)) / kAllowedError;
    if (worst > 1.0) return worst;
    vec3 upTo = max(vec3(dot(density, kUpToFirst), dot(density, kUpToSecond),
                         dot(density, kUpToThird)) * distance, vec3(0));
    vec3 decay = expChannels(-depth);
    vec3 mean = kLinearWeights.x * expChannels(-extinction * upTo.x) +
                kLinearWeights.y * expChannels(-extinction * upTo.y) +
                kLinearWeights.z * expChannels(-extinction * upTo.z);
    vec3 source = medium.extinction * medium.albedo * early + medium.emission;
    path.radiance +=
        before * (source * (sum * meanDecay(depth, decay)) + change * (mean - decay));
    addDepth(path, depth);
    return worst;
}

#endif
