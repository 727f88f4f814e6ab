// SPDX-License-Identifier: Apache-2.0
// The background of every pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../common/camera.glsl"
#include "../common/environment.glsl"

layout(constant_id = 0) const bool kEnvironment = true;
layout(binding = kBindingOwn) uniform sampler2D environment;
layout(location = 0) out vec4 color;
layout(location = 1) out float opaqueT;

void main() {
    vec3 radiance = frame.background;
    if (kEnvironment) radiance = environmentRadiance(environment, makeRay(gl_FragCoord.xy).direction);
    color = vec4(radiance, 1.0);
    opaqueT = kNothingT;
}
