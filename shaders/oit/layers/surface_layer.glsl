// SPDX-License-Identifier: Apache-2.0
// A thin surface as a layer.
#ifndef BRUME_OIT_LAYERS_SURFACE_LAYER_GLSL
#define BRUME_OIT_LAYERS_SURFACE_LAYER_GLSL
#include "../../common/surface.glsl"
#include "../../common/triangle_hash.h"
#include "layer.glsl"

// False behind something opaque. `point` is what the ray meets.
bool findSurfaceLayer(out Layer layer, out SurfacePoint point) {
    point = findSurfacePoint();
    float coverage = point.material.coverage * point.color.a;
    vec3 transmission = point.material.transmission * point.color.rgb;
    layer.t = vec2(max(point.t, 0.0));
    layer.radiance = coverage * sentRadiance(point, point.material.reflected);
    layer.loss = coverage * (1.0 - transmission);
    if (!kColoured) layer.loss = vec3(meanOf(layer.loss));
    layer.depth = depthFromLoss(layer.loss);
    layer.primitive = triangleHash(push.mesh, triangle) ^ (point.isFront ? 0u : 0x80000000u);
    layer.object = triangleHash(push.mesh, 0xffffffffu);
    return point.t < opaqueDistance();
}

vec4 findShares(Layer layer, vec4 shares) { return layer.t.xxxx; }

#endif
