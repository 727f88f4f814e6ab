// SPDX-License-Identifier: Apache-2.0
// How much of a light reaches a point: the one function that every shader calls which lights
// something, whatever store the light has.
#ifndef BRUME_SHADOWS_TRANSMITTANCE_GLSL
#define BRUME_SHADOWS_TRANSMITTANCE_GLSL
#include "common/maps.h"

// Stores that the lights of the scene use; the others leave no code behind.
layout(constant_id = kConstantShadowStores) const uint kShadowStores = 127u;

// Of the distance from a point or spot light, that light on media is followed in; chosen by us: the
// width of three texels of a face of 256.
const float kStepPerDistance = 0.02;

// Texels along the normal per texel that a look-up reaches; the diagonal takes sqrt 2.
const float kOffsetPerReach = 1.5;

#include "exact/transmittance.glsl"
#include "fourier/transmittance.glsl"
#include "opaque/transmittance.glsl"
#include "stochastic/transmittance.glsl"
#include "stochastic_vsm/transmittance.glsl"
#include "total/transmittance.glsl"
#include "visibility/transmittance.glsl"

vec3 storeTransmittance(ShadowMap map, vec3 position, MapPoint point) {
    vec3 t = vec3(1);
    if ((kShadowStores & kStoreExact) != 0u && map.store == kStoreExact)
        t = exactTransmittance(map, position, point);
    if ((kShadowStores & kStoreTotal) != 0u && map.store == kStoreTotal)
        t = totalTransmittance(map, point);
    if ((kShadowStores & kStoreVisibility) != 0u && map.store == kStoreVisibility)
        t = visibilityTransmittance(map, point);
    if ((kShadowStores & kStoreStochastic) != 0u && map.store == kStoreStochastic)
        t = stochasticTransmittance(map, point);
    if ((kShadowStores & kStoreStochasticVsm) != 0u && map.store == kStoreStochasticVsm)
        t = stochasticVsmTransmittance(map, point);
    if ((kShadowStores & kStoreFourier) != 0u && map.store == kStoreFourier)
        t = fourierTransmittance(map, point);
    return t;
}

// Share of light `index` that reaches `position` (camera-relative), per channel in [0, 1].
vec3 transmittance(uint index, vec3 position) {
    if (kShadowStores == 0u || lights[index].shadow == 0ul) return vec3(1);
    ShadowMap map = ShadowMapRef(lights[index].shadow).map;
    vec3 t = vec3(1);
    MapPoint point = locateInMap(map, position);
    if (point.isInside) t = storeTransmittance(map, position, point);
    if ((kShadowStores & kStoreOpaque) != 0u && map.opaque != 0ul) {
        map = ShadowMapRef(map.opaque).map;
        point = locateInMap(map, position);
        if (point.isInside) t *= opaqueVisibility(map, point);
    }
    return t;
}

// Whether the light's shadow has no error of its own.
bool hasExactShadow(uint index) {
    return lights[index].shadow != 0ul && ShadowMapRef(lights[index].shadow).map.store == kStoreExact;
}

// How far a ray may go from `position` while the light on media can be taken as smooth, m.
float shadowStep(uint index, vec3 position, vec3 direction) {
    if (kShadowStores == 0u || lights[index].shadow == 0ul) return 1e30;
    ShadowMap map = ShadowMapRef(lights[index].shadow).map;
    // Texels of a cube grow with the distance.
    if (map.isDirectional == 0u)
        return max(map.stepLength, kStepPerDistance * length(position - map.origin));
    // Outside the beam of a directional map there is light until the ray enters it.
    vec3 p = mapCoordinates(map, position);
    vec3 d = vec3(dot(direction, map.right), dot(direction, map.up), dot(direction, map.forward));
    float enter = 0.0, leave = 1e30;
    for (int axis = 0; axis < 3; ++axis) {
        float lo = axis < 2 ? -map.extent : map.begin, hi = axis < 2 ? map.extent : 1e30;
        bool isParallel = abs(d[axis]) < 1e-6;
        bool isInside = p[axis] > lo && p[axis] < hi;
        float divisor = isParallel ? 1.0 : d[axis];
        float a = (lo - p[axis]) / divisor, b = (hi - p[axis]) / divisor;
        enter = max(enter, isParallel ? 0.0 : min(a, b));
        leave = min(leave, isParallel ? (isInside ? 1e30 : -1.0) : max(a, b));
    }
    return leave > enter ? max(enter, map.stepLength) : 1e30;
}

// How far from a surface, along its normal, its light must be asked for: what rounding and the
// maps' texels call the surface may lie so far away. `isTranslucent`: it is in the store itself.
float shadowOffset(uint index, vec3 position, bool isTranslucent) {
    if (kShadowStores == 0u || lights[index].shadow == 0ul) return 0.0;
    ShadowMap map = ShadowMapRef(lights[index].shadow).map;
    float rounding = 4e-6 * max(max(abs(position.x), abs(position.y)), abs(position.z)) +
                     1e-6 * (map.end - map.begin);
    float texels = 0.0;
    if (isTranslucent && (map.store & (kStoreExact | kStoreOpaque)) == 0u)
        texels = kOffsetPerReach * texelSize(map, length(position - map.origin));
    if ((kShadowStores & kStoreOpaque) != 0u && map.opaque != 0ul) {
        map = ShadowMapRef(map.opaque).map;
        texels = max(texels, kOffsetPerReach * float(map.filterRadius + 1u) *
                                 texelSize(map, length(position - map.origin)));
    }
    return rounding + texels;
}

#endif
