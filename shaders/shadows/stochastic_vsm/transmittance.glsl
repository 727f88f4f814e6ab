// SPDX-License-Identifier: Apache-2.0
// Chebyshev's bound from the filtered moments of stochastic depths.
#ifndef BRUME_SHADOWS_STOCHASTIC_VSM_TRANSMITTANCE_GLSL
#define BRUME_SHADOWS_STOCHASTIC_VSM_TRANSMITTANCE_GLSL
#include "../common/map.glsl"
#include "../stochastic_vsm/moments.h"

vec3 stochasticVsmTransmittance(ShadowMap map, MapPoint point) {
    int size = int(map.resolution / kVsmReduction);
    vec2 position = point.texel / float(kVsmReduction) - 0.5;
    ivec2 corner = ivec2(floor(position));
    vec2 f = position - vec2(corner);
    vec3 mean = vec3(0), square = vec3(0);
    for (int i = 0; i < 4; ++i) {
        ivec2 o = ivec2(i & 1, i >> 1);
        vec2 weights = mix(1.0 - f, f, vec2(o));
        ivec2 t = clamp(corner + o, ivec2(0), ivec2(size - 1));
        uint texel = (point.face * uint(size) + uint(t.y)) * uint(size) + uint(t.x);
        for (uint c = 0u; c < map.channels; ++c) {
            uint at = 2u * (texel * map.channels + c);
            mean[c] += weights.x * weights.y * FloatArray(map.texels).at[at];
            square[c] += weights.x * weights.y * FloatArray(map.texels).at[at + 1u];
        }
    }
    if (map.channels == 1u) mean = mean.xxx, square = square.xxx;
    float z = vsmDepth(point.distance, map.begin, map.end);
    vec3 variance = max(square - mean * mean, vec3(1e-7));
    vec3 ahead = max(z - mean, 0.0);
    return variance / (variance + ahead * ahead);
}

#endif
