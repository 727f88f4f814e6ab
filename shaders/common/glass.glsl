// SPDX-License-Identifier: Apache-2.0
// The gloss of glass: what it mirrors and the highlights of lights on it. CPU twin:
// reference/surface_response.cpp and reference/lighting.cpp.
// Source: B. Walter, S. Marschner, H. Li, K. Torrance: "Microfacet Models for Refraction through
// Rough Surfaces", EGSR 2007 (GGX, Smith's masking, Fresnel's equations).
// Limits: the background is mirrored sharply whatever the roughness; scene and media are not.
#ifndef BRUME_COMMON_GLASS_GLSL
#define BRUME_COMMON_GLASS_GLSL

// Reflectance of one interface; `ior` >= 1, from outside.
float fresnelReflectance(float cosine, float ior) {
    float g = sqrt(ior * ior - 1.0 + cosine * cosine);
    float a = (g - cosine) / max(g + cosine, 1e-12);
    float b = (cosine * (g + cosine) - 1.0) / (cosine * (g - cosine) + 1.0);
    return 0.5 * a * a * (1.0 + b * b);
}

// A pane has two, between which light goes to and fro.
float glassReflectance(float cosine, float ior, bool isPane) {
    float one = fresnelReflectance(cosine, ior);
    return isPane ? 2.0 * one / (1.0 + one) : one;
}

// Reflected radiance per irradiance of a light: D V F cos. `n`, `v`, `l`: unit, all on one side.
float highlight(vec3 n, vec3 v, vec3 l, float ior, float roughness, bool isPane) {
    float nl = dot(n, l), nv = max(dot(n, v), 1e-4);
    if (nl <= 0.0) return 0.0;
    vec3 h = normalize(v + l);
    float a = max(roughness * roughness, 0.002), a2 = a * a;
    vec3 across = cross(n, h);
    float nh = dot(n, h), spread = dot(across, across) + a2 * nh * nh;
    float d = a2 / (3.14159265358979 * spread * spread);
    float masking = 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2));
    return d * masking * glassReflectance(dot(v, h), ior, isPane) * nl;
}

#endif
