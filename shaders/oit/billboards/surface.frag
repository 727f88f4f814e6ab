// SPDX-License-Identifier: Apache-2.0
// A thin surface for blending with "over"; a solid by its faces alone is not a medium here and
// shows nothing.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/surface.glsl"

layout(binding = kBindingOpaqueT) uniform sampler2D opaqueT;
layout(location = 0) out vec4 color;

void main() {
    SurfacePoint point = findSurfacePoint();
    if (point.material.type == kMaterialSolid ||
        point.t >= texelFetch(opaqueT, ivec2(gl_FragCoord.xy), 0).x)
        discard;
    float coverage = point.material.coverage * point.color.a;
    vec3 transmission = point.material.transmission * point.color.rgb;
    color.rgb = coverage * sentRadiance(point, point.material.reflected);
    color.a = coverage * (1.0 - (transmission.x + transmission.y + transmission.z) / 3.0);
}
