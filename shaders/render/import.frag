// SPDX-License-Identifier: Apache-2.0
// What a host has drawn, as everything else wants it: radiance, distance along the ray, reversed
// depth.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../common/camera.glsl"
#include "backdrop.h"

layout(push_constant, scalar) uniform Push { BackdropPush push; };
layout(binding = kBindingHostDepth) uniform sampler2D hostDepth;
layout(binding = kBindingHostColor) uniform sampler2D hostColor;
layout(location = 0) out vec4 color;
layout(location = 1) out float opaqueT;

const float kNothing = 3.0e38;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy) + ivec2(push.offsetX, push.offsetY);
    color = vec4(texelFetch(hostColor, pixel, 0).rgb, 1.0);
    float d = texelFetch(hostDepth, pixel, 0).x;
    precise float divisor = d * push.c - push.a;
    precise float depth = (push.b - d * push.e) / divisor;
    bool isNothing = d == push.farDepth || divisor == 0.0 || !(depth < 1e30);
    // A ray that is not the camera's axis is longer than its depth.
    vec3 direction = makeRay(gl_FragCoord.xy).direction;
    float cosine = hasParallelRays() ? 1.0 : dot(direction, frame.forward);
    opaqueT = isNothing ? kNothing : max(depth, 0.0) / cosine;
    float reversed = hasParallelRays() ? (frame.far - depth) / (frame.far - frame.near)
                                              : frame.near / max(depth, frame.near);
    gl_FragDepth = isNothing ? 0.0 : clamp(reversed, 0.0, 1.0);
}
