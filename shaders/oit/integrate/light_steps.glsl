// SPDX-License-Identifier: Apache-2.0
// How far a step may go in light that varies.
#ifndef BRUME_OIT_INTEGRATE_LIGHT_STEPS_GLSL
#define BRUME_OIT_INTEGRATE_LIGHT_STEPS_GLSL
#include "../../common/lighting.glsl"

const float kNoCrossing = 1e30;

// The next place ahead at which the ray, `offset` from the apex of a cone, crosses it.
float nextConeCrossing(vec3 rayDirection, vec3 offset, vec3 axis, float cosAngle, float slack) {
    float oa = dot(offset, axis), da = dot(rayDirection, axis), c2 = cosAngle * cosAngle;
    float a = da * da - c2, b = oa * da - c2 * dot(offset, rayDirection);
    float c = oa * oa - c2 * dot(offset, offset);
    float q = -(b + (b < 0.0 ? -1.0 : 1.0) * sqrt(max(b * b - a * c, 0.0)));
    float t1 = q / (abs(a) > 1e-20 ? a : 1e-20), t2 = c / (abs(q) > 1e-20 ? q : 1e-20);
    return min(t1 > slack ? t1 : kNoCrossing, t2 > slack ? t2 : kNoCrossing);
}

// A step short enough for the nodes near a point or spot light: 1/d^2 has its poles at the light,
// and kinks where it is capped at the light's radius and at the cones of a spot, which steps must
// not cross.
float limitStepByLight(LightData light, vec3 origin, vec3 rayDirection, float place) {
    vec3 offset = light.position - origin;
    float nearest = dot(offset, rayDirection), ahead = nearest - place;
    vec3 across = offset - nearest * rayDirection;
    float aside2 = dot(across, across);
    float distance = sqrt(ahead * ahead + aside2);
    float chord = sqrt(max(light.radius * light.radius - aside2, 0.0));
    float enter = ahead - chord, leave = ahead + chord, slack = 1e-3 * light.radius;
    float own = ahead > 0.0 ? max(distance / 3.0, 0.5 * sqrt(aside2)) : distance * 0.5;
    if (enter > slack)
        own = min(own, chord > 0.0 ? enter : own);
    else if (leave > slack)
        own = min(leave, 0.5 * light.radius);
    if (light.type == kLightSpot) {
        vec3 fromLight = place * rayDirection - offset;
        float near = 1e-5 * distance;
        own = min(own,
                  nextConeCrossing(rayDirection, fromLight, light.direction, light.cosInner, near));
        own = min(own,
                  nextConeCrossing(rayDirection, fromLight, light.direction, light.cosOuter, near));
    }
    return max(own, slack);
}

// `isSampled`: shadows are asked for along the ray.
float limitStepByLights(vec3 origin, vec3 rayDirection, float place, bool isSampled) {
    float limit = kNoCrossing;
    for (uint i = 0u; i < frame.lightCount; ++i) {
        if (lights[i].type != kLightDirectional)
            limit = min(limit, limitStepByLight(lights[i], origin, rayDirection, place));
        if (isSampled)
            limit = min(limit, shadowStep(i, origin + rayDirection * place, rayDirection));
    }
    return limit;
}

#endif
