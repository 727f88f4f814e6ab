// SPDX-License-Identifier: Apache-2.0
// Thin surfaces of method weighted, with what they blur and refract; solids refract only.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../layers/surface_layer.glsl"
#include "store.glsl"

layout(constant_id = kWeightedDiffusion) const bool kDiffusion = false;
layout(constant_id = kWeightedBlurWidth) const float kBlurWidth = 0.1;
layout(constant_id = kWeightedBlurReach) const float kBlurReach = 0.5;
layout(constant_id = kWeightedBehind) const float kBehind = 2.0;

// Pixels per metre at distance 1, or anywhere in an orthographic image.
float focalPixels() { return float(frame.size.x) / (2.0 * frame.extentX); }

// Eq. 7: variance in pixels of the background's blur by one surface.
float blurOf(SurfacePoint point, float coverage) {
    float gap = max(opaqueDistance() - point.t, 0.0);
    float reach = 1.0 - 1.0 / (1.0 + gap / kBlurReach);
    float distance = hasParallelRays() ? 1.0 : max(point.t, 1e-6);
    float deviation =
        focalPixels() * kBlurWidth * (1.0 - point.material.collimation) * coverage * reach / distance;
    return min(deviation * deviation, kMaxBlur * kMaxBlur);
}

// Eq. 8 and 9: by how many pixels the background seems displaced.
vec2 refractionOf(SurfacePoint point, Ray ray) {
    float eta = 1.0 / point.material.ior;
    float cosine = -dot(point.normal, ray.direction);
    float k = 1.0 - eta * eta * (1.0 - cosine * cosine);
    if (k < 0.0) return vec2(0);
    vec3 direction = eta * ray.direction + (eta * cosine - sqrt(k)) * point.normal;
    float along = max(dot(direction, frame.forward), 1e-3);
    vec3 seen = point.position + direction * (kBehind / along);
    vec3 view = vec3(dot(seen, frame.right), -dot(seen, frame.up), dot(seen, frame.forward));
    vec2 plane = hasParallelRays() ? view.xy : view.xy / max(view.z, 1e-6);
    plane -= vec2(frame.centerX, -frame.centerY);
    vec2 pixel = (plane / vec2(frame.extentX, frame.extentY) * 0.5 + 0.5) * vec2(frame.size);
    return clamp(pixel - gl_FragCoord.xy, vec2(-512.0), vec2(512.0));
}

void main() {
    Layer layer;
    SurfacePoint point;
    bool isLayer = findSurfaceLayer(layer, point);
    bool isSolid = point.material.type == kMaterialSolid;
    bool isRefracted = kRefraction && (!isSolid || point.isFront) && point.t < opaqueDistance();
    if (!isLayer && !isRefracted) discard;
    if (!isLayer) layer.radiance = layer.loss = layer.depth = vec3(0);
    float coverage = isSolid ? 1.0 : point.material.coverage * point.color.a;
    vec4 offset = vec4(0);
    if (isRefracted)
        offset = coverage * vec4(refractionOf(point, makeRay(gl_FragCoord.xy)), 1.0, layer.t.x);
    storeWeighted(layer, offset, kDiffusion && !isSolid ? blurOf(point, coverage) : 0.0);
}
