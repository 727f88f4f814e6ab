// SPDX-License-Identifier: Apache-2.0
// Reads the visibility curves of the four nearest texels.
#ifndef BRUME_SHADOWS_VISIBILITY_TRANSMITTANCE_GLSL
#define BRUME_SHADOWS_VISIBILITY_TRANSMITTANCE_GLSL
#include "../common/map.glsl"

// A node is its distance and the optical depth just before and just behind it, per channel; nodes
// that are not used stand at 3e38. Between nodes the depth is linear.
vec3 curveDepth(FloatArray values, uint first, uint stride, uint channels, float distance,
                uint count) {
    vec3 depth = vec3(0);
    float z0 = values.at[first];
    bool isPassed = z0 < distance;
    for (uint k = 0u; k < count; ++k) {
        uint node = first + k * stride;
        float z = values.at[node];
        if (z >= distance) {
            // Where the curve is going: its value just before this node.
            if (isPassed && z < 2.0e38) {
                vec3 before = channels == 1u ? vec3(values.at[node + 1u])
                                             : vec3(values.at[node + 1u], values.at[node + 2u],
                                                    values.at[node + 3u]);
                depth += (before - depth) * ((distance - z0) / (z - z0));
            }
            break;
        }
        depth = channels == 1u
                    ? vec3(values.at[node + 2u])
                    : vec3(values.at[node + 4u], values.at[node + 5u], values.at[node + 6u]);
        z0 = z;
    }
    return depth;
}

vec3 visibilityTransmittance(ShadowMap map, MapPoint point) {
    ivec2 corner = ivec2(floor(point.texel - 0.5));
    vec2 f = point.texel - 0.5 - vec2(corner);
    uint stride = 1u + 2u * map.channels;
    vec3 sum = vec3(0);
    for (int i = 0; i < 4; ++i) {
        ivec2 o = ivec2(i & 1, i >> 1);
        vec2 weight = mix(1.0 - f, f, vec2(o));
        uint first = texelIndex(map, point.face, corner + o) * map.count * stride;
        sum += weight.x * weight.y *
               exp(-curveDepth(FloatArray(map.texels), first, stride, map.channels, point.distance,
                               map.count));
    }
    return sum;
}

#endif
