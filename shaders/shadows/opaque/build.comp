// SPDX-License-Identifier: Apache-2.0
// The distance of the nearest opaque surface along each texel's ray.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../common/casters.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { ShadowPush push; };
layout(buffer_reference, scalar) writeonly buffer Distances { float at[]; };

void main() {
    ShadowMap map = ShadowMapRef(push.map).map;
    BuildTexel b = findBuildTexel(map, gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x,
                                  gl_LocalInvocationIndex);
    if (!b.isInside) return;
    Ray ray = mapRay(map, b.face, vec2(b.texel) + 0.5);
    float nearest = 3.0e38;
    uint k = UintArray(map.triangleOffsets).at[b.tile];
    uint last = UintArray(map.triangleOffsets).at[b.tile + 1u];
    // Textures are looked at when each ray has found its next triangle: some devices work through
    // both sides of an if, with all texels that they look at together.
    while (k < last) {
        ShadowTriangle triangle;
        TriangleHit hit;
        bool isMet = false;
        for (; k < last && !isMet; ++k) {
            triangle = ShadowTriangles(map.triangles).at[UintArray(map.trianglePairs).at[k]];
            isMet = ShadowMaterials(map.materials).at[triangle.material].type == kMaterialOpaque &&
                    intersectTriangle(ray, triangle, hit) && hit.t > 0.0 && hit.t < nearest;
        }
        for (bool isOne = isMet; isOne; isOne = false) {
            ShadowMaterial material = ShadowMaterials(map.materials).at[triangle.material];
            if (surfaceTransmittance(triangle, material, hit.weights) == vec3(0)) nearest = hit.t;
        }
    }
    Distances(push.target).at[b.index] = nearest;
}
