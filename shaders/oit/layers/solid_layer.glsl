// SPDX-License-Identifier: Apache-2.0
// All solids that a ray crosses, as one layer from the first face to the last: their optical depth
// together is exact, its distribution in between is taken as even.
#ifndef BRUME_OIT_LAYERS_SOLID_LAYER_GLSL
#define BRUME_OIT_LAYERS_SOLID_LAYER_GLSL
#include "../../common/lighting.glsl"
#include "layer.glsl"

layout(binding = kBindingSolidDepth) uniform sampler2D solidDepth;
layout(binding = kBindingSolidSource) uniform sampler2D solidSource;
layout(binding = kBindingSolidRange) uniform sampler2D solidRange;

bool findSolidLayer(out Layer layer) {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    vec4 depth = texelFetch(solidDepth, texel, 0);
    vec2 range = texelFetch(solidRange, texel, 0).xy;
    // More faces left than entered: the eye is inside.
    layer.t = vec2(depth.a < -0.5 ? 0.0 : -range.x, range.y);
    Ray ray = makeRay(layerPixel());
    MediumData isotropic = MediumData(vec3(0), kPhaseIsotropic, vec3(0), 0.0, vec3(0));
    vec3 middle = ray.origin + ray.direction * (0.5 * (layer.t.x + layer.t.y));
    vec3 light = scatteredRadiance(isotropic, kNoShares, middle, ray.direction);
    // Sums of differences may fall a rounding below zero.
    setMedium(layer, max(depth.rgb, vec3(0)), max(texelFetch(solidSource, texel, 0).rgb, vec3(0)) * light);
    layer.primitive = layer.object = 0x50be1d5u;
    return layer.t.y > layer.t.x;
}

vec4 findShares(Layer layer, vec4 shares) { return mix(layer.t.xxxx, layer.t.yyyy, shares); }

#endif
