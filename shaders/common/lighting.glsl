// SPDX-License-Identifier: Apache-2.0
// How much light arrives at a point, and what a medium scatters of it towards the eye.
#ifndef BRUME_COMMON_LIGHTING_GLSL
#define BRUME_COMMON_LIGHTING_GLSL
#include "../shadows/transmittance.glsl"
#include "bindings.glsl"
#include "phase.glsl"
#include "shadowing.glsl"

layout(constant_id = kConstantPointLights) const bool kPointLights = true;

// Irradiance on a plane facing a light, at `offset` from it and with nothing in between; `travel`:
// direction of the light there.
vec3 irradianceBeside(LightData light, vec3 offset, out vec3 travel) {
    if (!kPointLights || light.type == kLightDirectional) {
        travel = light.direction;
        return light.color;
    }
    float distance2 = dot(offset, offset);
    travel = distance2 > 0.0 ? offset * inversesqrt(distance2) : light.direction;
    float falloff = 1.0;
    if (light.type == kLightSpot) {
        float s = clamp((dot(travel, light.direction) - light.cosOuter) /
                            max(light.cosInner - light.cosOuter, 1e-6),
                        0.0, 1.0);
        falloff = s * s;
    }
    return light.color * (falloff / max(distance2, light.radius * light.radius));
}

// The same at `position`.
vec3 freeIrradiance(LightData light, vec3 position, out vec3 travel) {
    return irradianceBeside(light, position - light.position, travel);
}

// From a light to a place whose rounding is known. Close to a light that almost touches a surface,
// the cosine there is a difference of positions that agree in most digits.
vec3 fineOffset(LightData light, vec3 position, vec3 positionLo) {
    precise vec3 offset = (position - light.position) + (positionLo - light.positionLo);
    return offset;
}

// The same, shadowed; `index`: of the light.
vec3 lightIrradiance(LightData light, uint index, vec3 position, out vec3 travel) {
    return freeIrradiance(light, position, travel) * transmittance(index, position);
}

layout(buffer_reference, scalar) readonly buffer LightShares { vec3 at[]; };

// Share of light `index` that arrives at a sphere which is shadowed as a whole.
vec3 wholeShare(uint shares, uint index) {
    return LightShares(frame.lightShares).at[shares * frame.lightCount + index];
}

// Share of a light at a place in a medium; `shares`: of its sphere, or kNoShares.
vec3 mediumShare(uint shares, uint index, vec3 position) {
    bool isWhole = kWholeShadows && shares != kNoShares;
    vec3 share = vec3(1);
    if (kSampledShadows && !isWhole) share = transmittance(index, position);
    if (isWhole) share = wholeShare(shares, index);
    return share;
}

// Radiance that a medium with albedo 1 scatters into `-rayDirection` per unit of optical depth;
// `shares`: of its sphere, or kNoShares.
vec3 scatteredRadiance(MediumData medium, uint shares, vec3 position, vec3 rayDirection) {
    vec3 sum = frame.ambient;
    for (uint i = 0u; i < lightCount(); ++i) {
        vec3 travel;
        vec3 irradiance = freeIrradiance(lightAt(i), position, travel);
        sum += irradiance * mediumShare(shares, i, position) *
               phaseFunction(medium.phase, medium.g, -dot(travel, rayDirection));
    }
    return sum;
}

// Lambert reflection with albedo 1; `normal` unit, towards the viewer; `positionLo`: what rounding has
// taken from `position`.
vec3 diffuseRadiance(vec3 position, vec3 positionLo, vec3 normal, bool isTranslucent) {
    vec3 sum = frame.ambient;
    for (uint i = 0u; i < lightCount(); ++i) {
        vec3 travel;
        vec3 lit = position + normal * shadowOffset(i, position, isTranslucent);
        LightData light = lightAt(i);
        vec3 irradiance = irradianceBeside(light, fineOffset(light, position, positionLo), travel) *
                          transmittance(i, lit);
        sum += irradiance * (max(-dot(travel, normal), 0.0) * 0.3183098861837907);
    }
    return sum;
}

#endif
