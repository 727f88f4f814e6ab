// SPDX-License-Identifier: Apache-2.0
// Total transmittance of everything along the light ray: right behind all of it.
#ifndef BRUME_SHADOWS_TOTAL_TRANSMITTANCE_GLSL
#define BRUME_SHADOWS_TOTAL_TRANSMITTANCE_GLSL
#include "../common/map.glsl"

vec3 loadChannels(FloatArray values, uint index, uint channels) {
    if (channels == 1u) return vec3(values.at[index]);
    return vec3(values.at[3u * index], values.at[3u * index + 1u], values.at[3u * index + 2u]);
}

// Bilinear between the centres of texels.
vec3 totalTransmittance(ShadowMap map, MapPoint point) {
    ivec2 corner = ivec2(floor(point.texel - 0.5));
    vec2 f = point.texel - 0.5 - vec2(corner);
    vec3 sum = vec3(0);
    for (int i = 0; i < 4; ++i) {
        ivec2 o = ivec2(i & 1, i >> 1);
        vec2 weight = mix(1.0 - f, f, vec2(o));
        sum += weight.x * weight.y *
               loadChannels(FloatArray(map.totals), texelIndex(map, point.face, corner + o),
                            map.channels);
    }
    return sum;
}

// The same by the tent of the stochastic maps.
vec3 filterTotals(ShadowMap map, MapPoint point) {
    int radius = int(map.filterRadius);
    ivec2 corner = ivec2(floor(point.texel - 0.5));
    vec3 sum = vec3(0);
    float weights = 0.0;
    for (int y = -radius; y <= radius + 1; ++y)
        for (int x = -radius; x <= radius + 1; ++x) {
            vec2 offset = vec2(corner + ivec2(x, y)) + 0.5 - point.texel;
            float weight =
                tentWeight(offset.x, float(radius)) * tentWeight(offset.y, float(radius));
            sum += weight * loadChannels(FloatArray(map.totals),
                                         texelIndex(map, point.face, corner + ivec2(x, y)),
                                         map.channels);
            weights += weight;
        }
    return sum / weights;
}

#endif
