// SPDX-License-Identifier: Apache-2.0
// What a ray meets on a triangle: distance, side, and the light that the surface sends to the eye.
#ifndef BRUME_COMMON_SURFACE_GLSL
#define BRUME_COMMON_SURFACE_GLSL
#define BRUME_SURFACE_PASS
#include "camera.glsl"
#include "environment.glsl"
#include "glass.glsl"
#include "lighting.glsl"
#include "mesh.h"
#include "texture.glsl"

layout(location = 0) in vec3 normal;
layout(location = 1) flat in uint triangle;
layout(location = 2) flat in vec4 plane;
layout(location = 3) flat in vec4 planeLo;
layout(location = 4) flat in vec4 textureU;
layout(location = 5) flat in vec4 textureULo;
layout(location = 6) flat in vec4 textureV;
layout(location = 7) flat in vec4 textureVLo;

layout(binding = kBindingMaterial, scalar) uniform MaterialBlock { MaterialData material; };
layout(binding = kBindingColorTexture) uniform sampler2D colorTexture;
layout(binding = kBindingEmissionTexture) uniform sampler2D emissionTexture;
layout(binding = kBindingEnvironment) uniform sampler2D environmentMap;
layout(constant_id = kConstantGlossy) const bool kGlossy = true;
layout(constant_id = kConstantTextured) const bool kTextured = true;
layout(constant_id = kConstantSolids) const bool kSolids = true;

struct SurfacePoint {
    MaterialData material;
    vec3 position;
    vec3 positionLo;  // what rounding has taken from it
    vec3 normal;  // unit, towards the viewer
    Real2 uv;     // texture coordinates
    vec4 color;   // of the texture
    float t;      // distance along the ray
    float tLo;    // what rounding has taken from it
    bool isFront;
};

Real linearAt(Real3 place, vec4 function, vec4 functionLo) {
    return dot(makeReal(function.xyz, functionLo.xyz), place) +
           makeReal(function.w, functionLo.w);
}

// Discards what an alpha cutoff removes. (Meshes without a texture that it removes are not drawn.)
SurfacePoint findSurfacePoint() {
    SurfacePoint point;
    Real3 planeNormal = makeReal(plane.xyz, planeLo.xyz);
    Real distance = makeReal(plane.w, planeLo.w);
    Real3 place = pixelPlace(gl_FragCoord.xy);
    Real3 along = hasParallelRays() ? makeReal(frame.forward, frame.forwardLo) : place;
    if (hasParallelRays()) distance -= dot(planeNormal, place);
    Real facing = dot(planeNormal, along);
    Real steps = distance / (abs(facing) > Real(1e-20) ? facing : Real(1e-20));
    point.isFront = facing < Real(0);
    Real3 position = along * steps;
    Real t = steps;
    if (hasParallelRays())
        position += place;
    else
        t *= sqrt(dot(place, place));
    point.t = float(t);
    point.tLo = findLo(t);
    point.position = vec3(position);
    point.positionLo = vec3(position - Real3(point.position));
    point.material = material;
    // Shaders branch on these: no compiler knows that nothing is added (see bindings.glsl).
    uint nothing = floatBitsToUint(gl_FragCoord.x) >> 31;
    point.material.type += nothing;
    point.material.roughness += float(nothing);
    point.material.alphaCutoff += float(nothing);
    point.uv = Real2(0);
    point.color = vec4(1);
    if (kTextured) {
        point.uv = Real2(linearAt(position, textureU, textureULo),
                         linearAt(position, textureV, textureVLo));
        point.color = sampleTexture(colorTexture, point.uv);
    }
    if (kTextured && point.color.a * material.coverage < point.material.alphaCutoff) discard;
    vec3 n = dot(normal, normal) > 0.0 ? normalize(normal) : plane.xyz;
    point.normal = dot(n, vec3(along)) > 0.0 ? -n : n;
    return point;
}

vec3 emittedRadiance(SurfacePoint point) {
    vec3 texel = vec3(1);
    if (kTextured) texel = sampleTexture(emissionTexture, point.uv).rgb;
    return point.material.emission * texel;
}

// Lambert reflection and emission.
vec3 sentRadiance(SurfacePoint point, vec3 albedo) {
    return albedo * point.color.rgb *
               diffuseRadiance(point.position, point.positionLo, point.normal,
                               point.material.type != kMaterialOpaque) +
           emittedRadiance(point);
}

bool isSolid(SurfacePoint point) { return kSolids && point.material.type == kMaterialSolid; }

// What a point of glass mirrors, and the share of light that this leaves for everything else.
struct Gloss {
    vec3 radiance;
    float rest;
};

Gloss findGloss(SurfacePoint point) {
    if (!kGlossy || point.material.roughness < 0.0) return Gloss(vec3(0), 1.0);
    bool isPane = point.material.type == kMaterialThin;
    vec3 direction = makeRay(gl_FragCoord.xy).direction;
    float cosine = max(-dot(point.normal, direction), 0.0);
    float share = glassReflectance(cosine, point.material.ior, isPane);
    Gloss gloss;
    gloss.rest = 1.0 - share;
    gloss.radiance = share * environmentRadiance(environmentMap,
                                                 direction + 2.0 * cosine * point.normal);
    // Lights do not reach the inner side of a solid.
    for (uint i = 0u; i < lightCount() && (isPane || point.isFront); ++i) {
        vec3 travel;
        vec3 lit = point.position + point.normal * shadowOffset(i, point.position, true);
        LightData light = lightAt(i);
        vec3 offset = fineOffset(light, point.position, point.positionLo);
        vec3 irradiance = irradianceBeside(light, offset, travel) * transmittance(i, lit);
        gloss.radiance += irradiance * highlight(point.normal, -direction, -travel,
                                                 point.material.ior, point.material.roughness,
                                                 isPane);
    }
    return gloss;
}

// L <- coverage (radiance + transmission L) + (1 - coverage) L.
struct ThinResponse {
    vec3 radiance;
    vec3 transmission;
    float coverage;
};

ThinResponse findThinResponse(SurfacePoint point) {
    Gloss gloss = findGloss(point);
    return ThinResponse(sentRadiance(point, gloss.rest * point.material.reflected) + gloss.radiance,
                        gloss.rest * point.material.transmission * point.color.rgb,
                        point.material.coverage * point.color.a);
}

#endif
