// SPDX-License-Identifier: Apache-2.0
// Product of all transmittances along each texel's ray; order does not matter.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../common/casters.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { ShadowPush push; };
layout(buffer_reference, scalar) buffer Totals { float at[]; };

vec3 depthSum = vec3(0), surfaceProduct = vec3(1);

void takePiece(float t0, float t1, vec3 depth, uint id) { depthSum += depth; }
void takeSurface(float t, vec3 transmittance, uint id) { surfaceProduct *= transmittance; }

bool hasRoom(uint pieces) { return true; }

void finishPieces(bool isLast) {}

#include "../common/walk.glsl"

void main() {
    ShadowMap map = ShadowMapRef(push.map).map;
    BuildTexel b = findBuildTexel(map, gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x,
                                  gl_LocalInvocationIndex);
    if (!b.isInside) return;
    uint from = beginRound(push, b.index);
    if (from == kAllCasters) return;
    uint next =
        walkCasters(map, b.tile, mapRay(map, b.face, vec2(b.texel) + 0.5), from, false);
    vec3 total = surfaceProduct * exp(-depthSum);
    for (uint c = 0u; c < map.channels; ++c) {
        uint at = map.channels * b.index + c;
        Totals(push.target).at[at] = total[c] * (from > 0u ? Totals(push.target).at[at] : 1.0);
    }
    endRound(push, b.index, next);
}
