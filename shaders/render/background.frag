// SPDX-License-Identifier: Apache-2.0
// What a ray sees that meets nothing: a constant or an environment map.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../common/angles.glsl"
#include "../common/bindings.glsl"
#include "../common/camera.glsl"

layout(binding = kBindingOwn) uniform sampler2D environment;
layout(location = 0) out vec4 color;
layout(location = 1) out float opaqueT;

// Latitude-longitude map, +y up; bilinear by hand, because filters round to 1/256 texel.
vec3 environmentRadiance(vec3 d) {
    vec2 size = vec2(frame.environmentSize);
    vec2 uv = vec2(preciseAtan2(d.x, -d.z) * 0.15915494309189535 + 0.5,
                   preciseAtan2(length(d.xz), d.y) * 0.3183098861837907);
    vec2 position = uv * size - 0.5;
    vec2 corner = floor(position), f = position - corner;
    ivec2 low = ivec2(corner), last = ivec2(frame.environmentSize) - 1;
    ivec2 x = ivec2((low.x + frame.environmentSize.x) % frame.environmentSize.x,
                    (low.x + 1 + frame.environmentSize.x) % frame.environmentSize.x);
    ivec2 y = clamp(ivec2(low.y, low.y + 1), ivec2(0), last.yy);
    return mix(mix(texelFetch(environment, ivec2(x.x, y.x), 0).rgb,
                   texelFetch(environment, ivec2(x.y, y.x), 0).rgb, f.x),
               mix(texelFetch(environment, ivec2(x.x, y.y), 0).rgb,
                   texelFetch(environment, ivec2(x.y, y.y), 0).rgb, f.x),
               f.y);
}

void main() {
    vec3 direction = makeRay(gl_FragCoord.xy).direction;
    color.rgb = frame.environmentSize.x > 0u
                    ? frame.environmentScale * environmentRadiance(direction)
                    : frame.background;
    color.a = 1.0;
    opaqueT = 3.0e38;
}
