// SPDX-License-Identifier: Apache-2.0
// Text and shapes: the texture is their coverage.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "ui.h"

layout(binding = kBindingUiTexture) uniform sampler2D coverage;
layout(location = 0) in vec2 uv;
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 result;

void main() { result = vec4(color.rgb, color.a * texture(coverage, uv).r); }
