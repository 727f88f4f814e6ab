// SPDX-License-Identifier: Apache-2.0
// Sums the hashes of the triangles that a pixel sees, for the comparison with a ray caster.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../common/surface.glsl"
#include "../common/triangle_hash.h"

layout(push_constant, scalar) uniform Push { MeshPush push; };
layout(binding = kBindingOpaqueT) uniform sampler2D opaqueT;
layout(binding = kBindingTriangles, scalar) buffer Triangles { uint triangles[]; };

void main() {
    SurfacePoint point = findSurfacePoint();
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float limit = texelFetch(opaqueT, pixel, 0).x;
    bool isSeen = point.material.type == kMaterialOpaque ? point.t == limit : point.t < limit;
    if (isSeen)
        atomicAdd(triangles[pixel.y * frame.size.x + pixel.x],
                  triangleHash(push.meshIndex, triangle));
}
