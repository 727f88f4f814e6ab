// SPDX-License-Identifier: Apache-2.0
// What a ray sees that meets nothing: a constant or an environment map.
#ifndef BRUME_COMMON_ENVIRONMENT_GLSL
#define BRUME_COMMON_ENVIRONMENT_GLSL
#include "angles.glsl"
#include "bindings.glsl"

// Latitude-longitude map, +y up; bilinear by hand, because filters round to 1/256 texel.
vec3 environmentTexel(sampler2D environment, vec3 d) {
    vec2 size = vec2(frame.environmentSize);
    vec2 uv = vec2(preciseAtan2(d.x, -d.z) * 0.15915494309189535 + 0.5,
                   preciseAtan2(length(d.xz), d.y) * 0.3183098861837907);
    vec2 position = uv * size - 0.5;
    vec2 corner = floor(position), f = position - corner;
    ivec2 low = ivec2(corner), last = ivec2(frame.environmentSize) - 1;
    ivec2 x = ivec2(low.x < 0 ? last.x : low.x, low.x < last.x ? low.x + 1 : 0);
    ivec2 y = clamp(ivec2(low.y, low.y + 1), ivec2(0), last.yy);
    return mix(mix(texelFetch(environment, ivec2(x.x, y.x), 0).rgb,
                   texelFetch(environment, ivec2(x.y, y.x), 0).rgb, f.x),
               mix(texelFetch(environment, ivec2(x.x, y.y), 0).rgb,
                   texelFetch(environment, ivec2(x.y, y.y), 0).rgb, f.x),
               f.y);
}

vec3 environmentRadiance(sampler2D environment, vec3 direction) {
    return frame.environmentSize.x > 0u
               ? frame.environmentScale * environmentTexel(environment, direction)
               : frame.background;
}

#endif
