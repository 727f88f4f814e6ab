// SPDX-License-Identifier: Apache-2.0
// The background of every pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../common/camera.glsl"
#include "../common/environment.glsl"

layout(binding = kBindingOwn) uniform sampler2D environment;
layout(location = 0) out vec4 color;
layout(location = 1) out float opaqueT;

void main() {
    color = vec4(environmentRadiance(environment, makeRay(gl_FragCoord.xy).direction), 1.0);
    opaqueT = 3.0e38;
}
