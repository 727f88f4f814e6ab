// SPDX-License-Identifier: Apache-2.0
// A thin surface, or what a face of a solid mirrors, as a layer.
#ifndef BRUME_OIT_LAYERS_SURFACE_LAYER_GLSL
#define BRUME_OIT_LAYERS_SURFACE_LAYER_GLSL
#include "../../common/surface.glsl"
#include "../../common/triangle_hash.h"
#include "layer.glsl"

// False behind something opaque, and for faces that mirror nothing. `point` is what the ray meets.
bool findSurfaceLayer(out Layer layer, out SurfacePoint point) {
    point = findSurfacePoint();
    layer.t = vec2(max(point.t, 0.0));
    if (isSolid(point)) {
        Gloss gloss = findGloss(point);
        layer.radiance = gloss.radiance;
        layer.loss = vec3(1.0 - gloss.rest);
    } else {
        ThinResponse response = findThinResponse(point);
        layer.radiance = response.coverage * response.radiance;
        layer.loss = response.coverage * (1.0 - response.transmission);
    }
    if (!kColoured) layer.loss = vec3(meanOf(layer.loss));
    // Where nothing varies over a surface, its material says it.
    bool isEven = !kTextured && !kGlossy;
    layer.depth = isEven ? point.material.depth : depthFromLoss(layer.loss);
    layer.primitive = triangleHash(push.mesh, triangle) ^ (point.isFront ? 0u : 0x80000000u);
    layer.object = triangleHash(push.mesh, 0xffffffffu);
    bool isSeen = !kOpaque || point.t < opaqueDistance();
    return isSeen && (!isSolid(point) || (kGlossy && point.material.roughness >= 0.0));
}

vec4 findShares(Layer layer, vec4 shares) { return layer.t.xxxx; }

#endif
