// SPDX-License-Identifier: Apache-2.0
// Percentage-closer filtering of the opaque map by a tent.
#ifndef BRUME_SHADOWS_OPAQUE_TRANSMITTANCE_GLSL
#define BRUME_SHADOWS_OPAQUE_TRANSMITTANCE_GLSL
#include "../common/map.glsl"

float opaqueVisibility(ShadowMap map, MapPoint point) {
    int radius = int(map.filterRadius);
    ivec2 corner = ivec2(floor(point.texel - 0.5));
    // Distances along rays round; a surface does not shadow what touches it.
    float distance = point.distance - 1e-5 * (map.end - map.begin) - 1e-6 * abs(point.distance);
    float sum = 0.0, weights = 0.0;
    for (int y = -radius; y <= radius + 1; ++y)
        for (int x = -radius; x <= radius + 1; ++x) {
            ivec2 texel = corner + ivec2(x, y);
            vec2 offset = vec2(texel) + 0.5 - point.texel;
            float weight =
                tentWeight(offset.x, float(radius)) * tentWeight(offset.y, float(radius));
            float nearest = FloatArray(map.texels).at[texelIndex(map, point.face, texel)];
            sum += distance < nearest ? weight : 0.0;
            weights += weight;
        }
    return sum / weights;
}

#endif
