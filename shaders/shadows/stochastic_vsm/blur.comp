// SPDX-License-Identifier: Apache-2.0
// Moments of the stochastic depths under a tent, one dimension per pass, kVsmReduction times
// smaller. Rays that nothing ends count as ended by the last caster's place, not as if far away:
// else a thin shadow vanishes.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../common/map.glsl"
#include "moments.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kIsSecond = false;  // down the columns of the first pass's rows
layout(push_constant, scalar) uniform Push { ShadowPush push; };
layout(buffer_reference, scalar) writeonly buffer Moments { float at[]; };

vec2 momentsOf(ShadowMap map, float depth) {
    float z = vsmDepth(depth, map.begin, map.end);
    return vec2(z, z * z);
}

// Of the stochastic map, all samples of a texel.
vec2 loadDepths(ShadowMap map, uint texel, uint channel) {
    vec2 sum = vec2(0);
    for (uint s = 0u; s < map.count; ++s)
        sum += momentsOf(
            map, FloatArray(push.source).at[(texel * map.count + s) * map.channels + channel]);
    return sum / float(map.count);
}

vec2 filterLine(ShadowMap map, uint face, uvec2 cell, uint channel) {
    uint size = map.resolution, reduced = size / kVsmReduction;
    int radius = int(map.filterRadius);
    float center = (float(kIsSecond ? cell.y : cell.x) + 0.5) * float(kVsmReduction);
    vec2 sum = vec2(0);
    float weights = 0.0;
    for (int i = -radius - 1; i <= radius; ++i) {
        int along = int(floor(center)) + i;
        float weight = tentWeight(float(along) + 0.5 - center, float(radius));
        uint line = uint(clamp(along, 0, int(size) - 1));
        if (kIsSecond) {
            uint at = 2u * (((face * size + line) * reduced + cell.x) * map.channels + channel);
            sum +=
                weight * vec2(FloatArray(push.source).at[at], FloatArray(push.source).at[at + 1u]);
        } else {
            sum += weight * loadDepths(map, (face * size + cell.y) * size + line, channel);
        }
        weights += weight;
    }
    return sum / weights;
}

void main() {
    ShadowMap map = ShadowMapRef(push.map).map;
    uint thread = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u;
    if (thread >= push.count) return;
    uint reduced = map.resolution / kVsmReduction;
    uint rows = kIsSecond ? reduced : map.resolution;
    uvec2 cell = uvec2(thread % reduced, thread / reduced % rows);
    uint face = thread / (reduced * rows);
    for (uint c = 0u; c < map.channels; ++c) {
        vec2 moments = filterLine(map, face, cell, c);
        Moments(push.target).at[2u * (thread * map.channels + c)] = moments.x;
        Moments(push.target).at[2u * (thread * map.channels + c) + 1u] = moments.y;
    }
}
