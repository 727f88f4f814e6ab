// SPDX-License-Identifier: Apache-2.0
// Sums over the faces of solids: Beer's law needs only the distances at which a ray leaves them
// less those at which it enters, whatever their order.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/surface.glsl"
#include "layers.h"

layout(binding = kBindingOpaqueT) uniform sampler2D opaqueT;
layout(location = 0) out vec4 depth;
layout(location = 1) out vec4 source;
layout(location = 2) out vec2 range;

void main() {
    SurfacePoint point = findSurfacePoint();
    if (point.material.type != kMaterialSolid) discard;
    float limit = texelFetch(opaqueT, ivec2(gl_FragCoord.xy), 0).x;
    float t = clamp(point.t, 0.0, limit), sign = point.isFront ? -1.0 : 1.0;
    depth = vec4(point.material.extinction * (sign * t), -sign);
    source = vec4(point.material.scattering * (sign * t), 0.0);
    range = vec2(point.isFront ? -point.t : -3e38, point.isFront ? 0.0 : t);
}
