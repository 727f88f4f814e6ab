// SPDX-License-Identifier: Apache-2.0
// Optical depth up to a distance from its Fourier series (Jansen and Bavoil 2010, eq. 7 and 8).
#ifndef BRUME_SHADOWS_FOURIER_TRANSMITTANCE_GLSL
#define BRUME_SHADOWS_FOURIER_TRANSMITTANCE_GLSL
#include "../common/map.glsl"

const float kTwoPi = 6.283185307179586;

vec3 fourierTexel(ShadowMap map, uint texel, float z) {
    uint first = texel * map.count * map.channels;
    vec3 depth = vec3(0);
    for (uint c = 0u; c < map.channels; ++c)
        depth[c] = 0.5 * FloatArray(map.texels).at[first + c] * z;
    for (uint k = 1u; 2u * k < map.count; ++k) {
        float w = kTwoPi * float(k);
        float sine = sin(w * z) / w, cosine = (1.0 - cos(w * z)) / w;
        uint at = first + (2u * k - 1u) * map.channels;
        for (uint c = 0u; c < map.channels; ++c)
            depth[c] += FloatArray(map.texels).at[at + c] * sine +
                        FloatArray(map.texels).at[at + map.channels + c] * cosine;
    }
    if (map.channels == 1u) depth = depth.xxx;
    return exp(-max(depth, 0.0));
}

vec3 fourierTransmittance(ShadowMap map, MapPoint point) {
    ivec2 corner = ivec2(floor(point.texel - 0.5));
    vec2 f = point.texel - 0.5 - vec2(corner);
    float z = clamp((point.distance - map.begin) / (map.end - map.begin), 0.0, 1.0);
    vec3 sum = vec3(0);
    for (int i = 0; i < 4; ++i) {
        ivec2 o = ivec2(i & 1, i >> 1);
        vec2 weight = mix(1.0 - f, f, vec2(o));
        sum += weight.x * weight.y * fourierTexel(map, texelIndex(map, point.face, corner + o), z);
    }
    return sum;
}

#endif
