// SPDX-License-Identifier: Apache-2.0
// What a ray meets on a triangle: distance, side, and the light that the surface sends to the eye.
#ifndef BRUME_COMMON_SURFACE_GLSL
#define BRUME_COMMON_SURFACE_GLSL
#include "camera.glsl"
#include "lighting.glsl"
#include "mesh.h"

layout(location = 0) in vec3 normal;
layout(location = 1) in vec2 uv;
layout(location = 2) flat in vec4 plane;
layout(location = 3) flat in uint triangle;

layout(binding = kBindingMaterial, scalar) uniform MaterialBlock { MaterialData material; };
layout(binding = kBindingColorTexture) uniform sampler2D colorTexture;
layout(binding = kBindingEmissionTexture) uniform sampler2D emissionTexture;

struct SurfacePoint {
    MaterialData material;
    vec3 position;
    vec3 normal;  // unit, towards the viewer
    vec4 color;   // of the texture
    float t;      // distance along the ray
    bool isFront;
};

// Discards what an alpha cutoff removes.
SurfacePoint findSurfacePoint() {
    Ray ray = makeRay(gl_FragCoord.xy);
    SurfacePoint point;
    float facing = dot(plane.xyz, ray.direction);
    point.isFront = facing < 0.0;
    point.t = (plane.w - dot(plane.xyz, ray.origin)) / (abs(facing) > 1e-20 ? facing : 1e-20);
    point.position = ray.origin + ray.direction * point.t;
    point.material = material;
    point.color = textureLod(colorTexture, uv, 0.0);
    if (point.color.a * material.coverage < material.alphaCutoff) discard;
    vec3 n = dot(normal, normal) > 0.0 ? normalize(normal) : plane.xyz;
    point.normal = dot(n, ray.direction) > 0.0 ? -n : n;
    return point;
}

vec3 emittedRadiance(SurfacePoint point) {
    return point.material.emission * textureLod(emissionTexture, uv, 0.0).rgb;
}

// Lambert reflection and emission.
vec3 sentRadiance(SurfacePoint point, vec3 albedo) {
    return albedo * point.color.rgb * diffuseRadiance(point.position, point.normal) +
           emittedRadiance(point);
}

#endif
