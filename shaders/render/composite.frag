// SPDX-License-Identifier: Apache-2.0
// The composed image into the host's colours.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "backdrop.h"

layout(push_constant, scalar) uniform Push { BackdropPush push; };
layout(binding = kBindingComposed) uniform sampler2D composed;
layout(location = 0) out vec4 color;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy) - ivec2(push.offsetX, push.offsetY);
    color = vec4(texelFetch(composed, pixel, 0).rgb, 1.0);
}
