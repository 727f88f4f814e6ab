// SPDX-License-Identifier: Apache-2.0
// A picture of linear radiance as a PNG shows it: toneMap() of core/image_io.hpp, then sRGB.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "ui.h"

layout(push_constant, scalar) uniform Push { UiPush push; };
layout(binding = kBindingUiTexture) uniform sampler2D radiance;
layout(location = 0) in vec2 uv;
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 result;

void main() {
    vec3 x = max(texture(radiance, uv).rgb * push.gain, vec3(0.0));
    vec3 shoulder = 1.0 - 0.2 / (1.0 + (x - 0.8) / 0.2);
    vec3 y = mix(x, shoulder, greaterThan(x, vec3(0.8)));
    vec3 bright = 1.055 * pow(max(y, vec3(1e-6)), vec3(1.0 / 2.4)) - 0.055;
    result = vec4(mix(bright, 12.92 * y, lessThanEqual(y, vec3(0.0031308))), 1.0) * color;
}
