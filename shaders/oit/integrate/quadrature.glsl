// SPDX-License-Identifier: Apache-2.0
// One step through media whose extinction or source vary: Gauss's rule with five points, because
// those of three leave the light of a mixture off by 1e-4.
#ifndef BRUME_OIT_INTEGRATE_QUADRATURE_GLSL
#define BRUME_OIT_INTEGRATE_QUADRATURE_GLSL
#extension GL_EXT_control_flow_attributes : require
#include "path.glsl"

// Gauss-Legendre nodes and weights on [0, 1], and the integrals of the node polynomials up to each
// node (the Butcher matrix of the five-stage Gauss method).
const int kNodeCount = 5;
const float kNodes[kNodeCount] =
    float[](0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842, 0.953089922969332);
const float kWeights[kNodeCount] = float[](0.118463442528095, 0.239314335249683, 0.284444444444444,
                                           0.239314335249683, 0.118463442528095);
const float kUpTo[kNodeCount * kNodeCount] =  // row k: from 0 to node k
    float[](0.059231721264, -0.019570364359, 0.011254400819, -0.005593793661, 0.001588112968,
            0.128151005670, 0.119657167625, -0.024592114620, 0.010318280671, -0.002768994399,
            0.113776288004, 0.260004651681, 0.142222222222, -0.020690316431, 0.004687154524,
            0.121232436927, 0.228996054579, 0.309036559064, 0.119657167625, -0.009687563142,
            0.116875329560, 0.244908128910, 0.273190043626, 0.258884699609, 0.059231721264);

// Of the radiance in one step (chosen by us, so that the hard rays of the tests are exact to 1e-5).
const float kAllowedError = 1e-6;
// Error of the nodes, in parts of the variation: smooth * depth^3 + wide * depth^2 * share^4, with
// the share of a smooth sphere's chord that the step covers (fitted to random mixtures, of which
// at most one in a hundred exceeds it).
const float kErrorOfDepth = 8e-5;
const float kErrorOfShare = 6e-4;

struct Nodes {
    vec3 extinction[kNodeCount];
    vec3 source[kNodeCount];
    float share;  // largest of a smooth sphere's chord that they span
};

// Integrates source * exp(-depth) over one step. The mean source radiance is taken exactly; only
// its variation within the step is left to the nodes. Returns the estimated error in units of what
// is allowed; above 1 nothing is done.
float crossVarying(inout Path path, Nodes nodes, float distance) {
    vec3 extinction = vec3(0), source = vec3(0);
    [[unroll]] for (uint k = 0u; k < kNodeCount; ++k) {
        extinction += kWeights[k] * nodes.extinction[k];
        source += kWeights[k] * nodes.source[k];
    }
    vec3 depth = min(extinction * distance, vec3(1e30));
    vec3 before = path.surfaces * path.decay;
    vec3 mean = source / max(extinction, vec3(1e-30));
    vec3 variation = vec3(0), size = vec3(0), deviation = vec3(0);
    [[unroll]] for (uint k = 0u; k < kNodeCount; ++k) {
        vec3 depthAtNode = vec3(0);
        [[unroll]] for (uint j = 0u; j < kNodeCount; ++j) {
            depthAtNode += kUpTo[kNodeCount * k + j] * nodes.extinction[j];
        }
        depthAtNode *= distance;
        vec3 difference = nodes.source[k] - mean * nodes.extinction[k];
        variation += kWeights[k] * difference * expChannels(-max(depthAtNode, 0.0));
        size += kWeights[k] * abs(difference);
        deviation = max(deviation, abs(difference) / max(nodes.extinction[k], vec3(1e-30)));
    }
    // No light comes from where there is nothing, only rounding.
    bvec3 empty = lessThan(depth, vec3(1e-7));
    // What is left to the nodes cannot exceed the deviation of the source radiance from its mean,
    // which in dense media is but rounding; of that they get more wrong the deeper the step.
    vec3 bound = min(mix(size * distance, vec3(0), empty), deviation);
    variation = clamp(variation * distance, -bound, bound);
    float share2 = nodes.share * nodes.share;
    vec3 part = depth * depth * (kErrorOfDepth * depth + kErrorOfShare * share2 * share2);
    vec3 error = before * bound * min(part, vec3(1));
    float worst = max(error.x, max(error.y, error.z)) / kAllowedError;
    if (worst > 1.0 && max(depth.x, max(depth.y, depth.z)) > 1e-3) return worst;
    crossConstant(path, extinction, source, distance);
    path.radiance += before * variation;
    return min(worst, 1.0);
}

// By which the next step may differ from one whose error this was: the error grows with a high
// power of the step.
float scaleStep(float error) {
    float scale = clamp(0.9 * pow(max(error, 1e-15), -0.25), 1e-6, 100.0);
    return error > 1.0 ? min(scale, 0.5) : scale;
}

#endif
