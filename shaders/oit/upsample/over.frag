// SPDX-License-Identifier: Apache-2.0
// Media that were blended with "over" at low resolution, as one layer of the full image.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/bindings.glsl"
#include "joint_bilateral.glsl"
#include "upsample.h"

layout(constant_id = kUpsampleScale) const uint kScale = 2u;
layout(binding = kBindingOpaqueT) uniform sampler2D opaqueT;
layout(binding = kBindingLowMedia) uniform sampler2D lowMedia;
layout(location = 0) out vec4 color;  // alpha: what the media take

void main() {
    color = readLow(lowMedia, findLowTexels(opaqueT, ivec2(gl_FragCoord.xy), kScale));
    if (color == vec4(0)) discard;
}
