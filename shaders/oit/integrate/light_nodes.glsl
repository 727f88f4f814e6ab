// SPDX-License-Identifier: Apache-2.0
// One light at the nodes of a step.
#ifndef BRUME_OIT_INTEGRATE_LIGHT_NODES_GLSL
#define BRUME_OIT_INTEGRATE_LIGHT_NODES_GLSL
#include "../../common/lighting.glsl"
#include "quadrature.glsl"

struct LightNodes {
    vec3 irradiance[kNodeCount];  // with nothing in between
    vec3 share[kNodeCount];       // that shadows leave at each node
    float cosTheta[kNodeCount];   // between its travel and the way to the eye
};

// Of one light and step, at most.
const uint kShadowLookups =
    !kSampledShadows ? 0u : (kShadowStores & kStoreExact) != 0u ? kNodeCount : 2u;

// Share of light `index` at the nodes. Stores that are right to 1e-3 anyway are asked twice, at
// Gauss's points (inside the step: at its ends the light may jump), and taken as linear: that is
// off by less within shadowStep(). The exact store is asked at each node.
void shadowNodes(uint index, vec3 begin, vec3 alongStep, out vec3 share[kNodeCount]) {
    const float kEarly = 0.2113248654051871, kLate = 1.0 - kEarly;
    bool isExact = (kShadowStores & kStoreExact) != 0u && hasExactShadow(index);
    uint lookups = isExact ? kNodeCount : 2u;
    [[unroll]] for (uint j = 0u; j < kNodeCount; ++j) share[j] = vec3(0);
    for (uint k = 0u; k < lookups; ++k) {
        float place = k == 0u ? kEarly : kLate;
        if ((kShadowStores & kStoreExact) != 0u)
            [[unroll]] for (uint j = 0u; j < kNodeCount; ++j)
                place = isExact && j == k ? kNodes[j] : place;
        vec3 t = transmittance(index, begin + alongStep * place);
        [[unroll]] for (uint j = 0u; j < kNodeCount; ++j) {
            float late = (kNodes[j] - kEarly) / (kLate - kEarly);
            float weight = isExact ? float(j == k) : k == 0u ? 1.0 - late : late;
            share[j] += weight * t;
        }
    }
    [[unroll]] for (uint j = 0u; j < kNodeCount; ++j) share[j] = clamp(share[j], 0.0, 1.0);
}

// A step along a ray.
struct LitStep {
    vec3 begin, rayDirection;
    float distance;
    bool isSampled;  // shadows are asked for along it
};

// `index`: of the light. Where `isVarying` is false, no light varies along the ray.
LightNodes makeLightNodes(LightData light, uint index, LitStep lit, const bool isVarying) {
    LightNodes nodes;
    [[unroll]] for (uint k = 0u; k < kNodeCount; ++k) nodes.share[k] = vec3(1);
    if (kSampledShadows && lit.isSampled && light.shadow != 0ul)
        shadowNodes(index, lit.begin, lit.rayDirection * lit.distance, nodes.share);
    [[unroll]] for (uint k = 0u; k < kNodeCount; ++k) {
        uint source = isVarying ? k : 0u;
        vec3 travel;
        vec3 position = lit.begin + lit.rayDirection * (lit.distance * kNodes[source]);
        nodes.irradiance[k] = freeIrradiance(light, position, travel);
        nodes.cosTheta[k] = -dot(travel, lit.rayDirection);
    }
    return nodes;
}

#endif
