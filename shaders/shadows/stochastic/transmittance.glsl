// SPDX-License-Identifier: Apache-2.0
// Percentage-closer filtering of stochastic depths by a tent, corrected by the total.
#ifndef BRUME_SHADOWS_STOCHASTIC_TRANSMITTANCE_GLSL
#define BRUME_SHADOWS_STOCHASTIC_TRANSMITTANCE_GLSL
#include "../total/transmittance.glsl"

vec3 stochasticTransmittance(ShadowMap map, MapPoint point) {
    int radius = int(map.filterRadius);
    ivec2 corner = ivec2(floor(point.texel - 0.5));
    vec3 reached = vec3(0), behind = vec3(0), totals = vec3(0);  // lit here, and behind everything
    float weights = 0.0;
    for (int y = -radius; y <= radius + 1; ++y)
        for (int x = -radius; x <= radius + 1; ++x) {
            vec2 offset = vec2(corner + ivec2(x, y)) + 0.5 - point.texel;
            float weight =
                tentWeight(offset.x, float(radius)) * tentWeight(offset.y, float(radius));
            uint texel = texelIndex(map, point.face, corner + ivec2(x, y));
            for (uint s = 0u; s < map.count; ++s) {
                vec3 depth =
                    loadChannels(FloatArray(map.texels), texel * map.count + s, map.channels);
                reached += weight * vec3(greaterThanEqual(depth, vec3(point.distance)));
                behind += weight * vec3(greaterThan(depth, vec3(2.0e38)));
            }
            if (map.totals != 0ul)
                totals += weight * loadChannels(FloatArray(map.totals), texel, map.channels);
            weights += weight;
        }
    reached /= weights * float(map.count);
    if (map.totals == 0ul) return reached;
    // The share that is lost in all is known; the samples only say how much of it is lost here.
    behind /= weights * float(map.count);
    totals /= weights;
    vec3 share = (1.0 - reached) / max(1.0 - behind, vec3(1e-6));
    return 1.0 - clamp(share, 0.0, 1.0) * (1.0 - totals);
}

#endif
