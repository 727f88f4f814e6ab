// SPDX-License-Identifier: Apache-2.0
// What every rastered method composites: a medium interval, a thin surface or the solids of a
// pixel, as L <- radiance + (1 - loss) L.
#ifndef BRUME_OIT_LAYERS_LAYER_GLSL
#define BRUME_OIT_LAYERS_LAYER_GLSL
#include "../../common/camera.glsl"
#include "../../common/exponential.glsl"
#include "../../common/opaque.glsl"
#include "layers.h"

layout(push_constant, scalar) uniform Push { LayerPush push; };
layout(constant_id = kLayerConstantBoxes) const bool kBoxes = true;
layout(constant_id = kLayerConstantVarying) const bool kVarying = true;
layout(constant_id = kLayerConstantColoured) const bool kColoured = true;
layout(constant_id = kLayerConstantScale) const uint kScale = 1u;

struct Layer {
    vec2 t;         // m along the ray, where it begins and ends; of a surface both are equal
    vec3 radiance;  // that it adds by itself, coverage and own attenuation included
    vec3 loss;      // 1 - transmittance, with all its digits; one value where not kColoured
    vec3 depth;     // -ln(transmittance), at most kMaxDepth
    uint primitive;
    uint object;
};

// Centre of the target's texel in pixels of the image.
vec2 layerPixel() { return gl_FragCoord.xy * float(kScale); }

float opaqueDistance() { return opaqueDistanceAt(ivec2(layerPixel())); }

// What orders layers that are not mixed: the middle, because many media may begin at the eye.
float layerKey(Layer layer) { return 0.5 * (layer.t.x + layer.t.y); }

float meanOf(vec3 v) { return (v.x + v.y + v.z) * (1.0 / 3.0); }

// -ln(1 - x) for 0 <= x <= 1: as 2 artanh(x / (2 - x)) where 1 - x has lost digits.
vec4 depthFromLoss(vec4 x) {
    vec4 y = x / (2.0 - x);
    vec4 y2 = y * y;
    vec4 series =
        2.0 * y * (1.0 + y2 * (1.0 / 3.0 + y2 * (1.0 / 5.0 + y2 * (1.0 / 7.0 + y2 / 9.0))));
    vec4 direct = -log(max(1.0 - x, vec4(1e-36)));
    return min(mix(direct, series, lessThan(x, vec4(0.25))), vec4(kMaxDepth));
}
vec3 depthFromLoss(vec3 x) { return depthFromLoss(vec4(x, 0.0)).xyz; }

// A layer from its optical depth and the radiance that it would send if it did not attenuate
// itself.
void setMedium(inout Layer layer, vec3 depth, vec3 source) {
    if (!kColoured) depth = depth.xxx;
    vec3 share = meanDecay(depth, kColoured ? exp(-depth) : vec3(exp(-depth.x)));
    layer.radiance = source * share;
    layer.depth = min(depth, vec3(kMaxDepth));
    layer.loss = min(depth * share, vec3(1.0));
}

#endif
