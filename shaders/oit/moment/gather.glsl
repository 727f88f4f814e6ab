// SPDX-License-Identifier: Apache-2.0
// Adds the radiance of a layer as seen through what the moments say is in front of it.
#ifndef BRUME_OIT_MOMENT_GATHER_GLSL
#define BRUME_OIT_MOMENT_GATHER_GLSL
#include "distribution.glsl"

layout(binding = kBindingMomentTotal) uniform sampler2D totals;
layout(binding = kBindingMomentLow) uniform sampler2D lowMoments;
layout(binding = kBindingMomentHigh) uniform sampler2D highMoments;
layout(location = 0) out vec4 sum;

void storeLayer(Layer layer) {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 total = texelFetch(totals, pixel, 0);
    float scale = 1.0 / max(total.a, 1e-20);
    vec4 high = kMoments > 4u ? texelFetch(highMoments, pixel, 0) * scale : vec4(0);
    float share = shareBefore(texelFetch(lowMoments, pixel, 0) * scale, high,
                              placeOf(vec3(layerKey(layer))).x);
    vec3 through = kColoured ? exp(-share * total.rgb) : vec3(exp(-share * total.r));
    // What only glows counts as a very thin layer.
    vec3 loss = max(layer.loss, vec3(1e-7));
    sum = vec4(through * layer.radiance, kColoured ? meanOf(through * loss) : through.x * loss.x);
}

#endif
