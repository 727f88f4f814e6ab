// SPDX-License-Identifier: Apache-2.0
// Opaque surfaces: their radiance and their distance along the ray.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../common/surface.glsl"

layout(location = 0) out vec4 color;
layout(location = 1) out float opaqueT;

void main() {
    SurfacePoint point = findSurfacePoint();
    color = vec4(sentRadiance(point, point.material.albedo), 1.0);
    opaqueT = point.t;
}
