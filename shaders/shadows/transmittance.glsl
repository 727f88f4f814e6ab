// SPDX-License-Identifier: Apache-2.0
// How much of a light reaches a point: the one function that every shader calls which lights
// something, whatever store the light has.
#ifndef BRUME_SHADOWS_TRANSMITTANCE_GLSL
#define BRUME_SHADOWS_TRANSMITTANCE_GLSL
#include "common/maps.h"

// Stores that the lights of the scene use; the others leave no code behind.
layout(constant_id = kConstantShadowStores) const uint kShadowStores = 127u;

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

// m within which light on media may be taken as smooth.
float shadowStep(uint index) {
    if (kShadowStores == 0u || lights[index].shadow == 0ul) return 1e30;
    return ShadowMapRef(lights[index].shadow).map.stepLength;
}

// How far from a surface, along its normal, its light must be asked for: what rounding and the
// map's texels call the surface may lie so far away.
float shadowOffset(uint index, vec3 position) {
    if (kShadowStores == 0u || lights[index].shadow == 0ul) return 0.0;
    ShadowMap map = ShadowMapRef(lights[index].shadow).map;
    float rounding = 4e-6 * max(max(abs(position.x), abs(position.y)), abs(position.z)) +
                     1e-6 * (map.end - map.begin);
    if ((kShadowStores & kStoreOpaque) == 0u || map.opaque == 0ul) return rounding;
    map = ShadowMapRef(map.opaque).map;
    return rounding +
           1.5 * float(map.filterRadius + 1u) * texelSize(map, length(position - map.origin));
}

#endif
