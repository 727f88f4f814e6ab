// SPDX-License-Identifier: Apache-2.0
// From distances to [-1, 1] over the range of the pixel, by their logarithm.
#ifndef BRUME_OIT_MOMENT_PLACE_GLSL
#define BRUME_OIT_MOMENT_PLACE_GLSL
#include "../layers/layer.glsl"
#include "moment.h"

layout(constant_id = kMomentCount) const uint kMoments = 4u;
layout(binding = kBindingMomentRange) uniform sampler2D ranges;

vec3 placeOf(vec3 t) {
    vec2 range = texelFetch(ranges, ivec2(gl_FragCoord.xy), 0).xy;
    // What begins at the eye would stretch the range without end.
    float far = range.y, near = max(-range.x, 1e-2 * far);
    float scale = 2.0 / max(log2(far / max(near, 1e-30)), 1e-6);
    return clamp(log2(max(t, near) / max(near, 1e-30)) * scale - 1.0, -1.0, 1.0);
}

// Gauss's nodes stand for the interval of a medium.
const vec3 kPlaceWeights = vec3(5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0);
vec3 placesOf(Layer layer) {
    return placeOf(mix(layer.t.xxx, layer.t.yyy, vec3(0.1127016653792583, 0.5, 0.8872983346207417)));
}

#endif
