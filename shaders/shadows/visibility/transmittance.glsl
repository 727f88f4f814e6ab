// SPDX-License-Identifier: Apache-2.0
// Reads the visibility curves of the four nearest texels.
#ifndef BRUME_SHADOWS_VISIBILITY_TRANSMITTANCE_GLSL
#define BRUME_SHADOWS_VISIBILITY_TRANSMITTANCE_GLSL
#include "../common/map.glsl"

// A node is its distance and the optical depth just before and just behind it, per channel; nodes
// that are not used stand at 3e38. Between nodes the depth is linear.
vec3 curveValue(FloatArray values, uint at, uint channels) {
    return channels == 1u ? vec3(values.at[at])
                          : vec3(values.at[at], values.at[at + 1u], values.at[at + 2u]);
}

vec3 curveDepth(FloatArray values, uint first, uint stride, uint channels, float distance,
                uint count) {
    // Only distances are looked at on the way: some devices load what a branch would not.
    uint next = 0u;
    while (next < count && values.at[first + next * stride] < distance) ++next;
    uint passed = first + (max(next, 1u) - 1u) * stride;
    uint ahead = first + min(next, count - 1u) * stride;
    vec3 depth = next > 0u ? curveValue(values, passed + 1u + channels, channels) : vec3(0);
    // Where the curve is going: its value just before the next node.
    float z0 = values.at[passed], z = values.at[ahead];
    bool isBetween = next > 0u && next < count && z < 2.0e38;
    float share = isBetween ? (distance - z0) / (z - z0) : 0.0;
    return depth + (curveValue(values, ahead + 1u, channels) - depth) * share;
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
