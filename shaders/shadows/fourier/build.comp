// SPDX-License-Identifier: Apache-2.0
// Fourier coefficients of the extinction along each texel's ray; they add up in any order.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../common/casters.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { ShadowPush push; };
layout(buffer_reference, scalar) buffer Coefficients { float at[]; };

const uint kMaxCoefficients = 15u;
const float kTwoPi = 6.283185307179586;
ShadowMap map;
vec3 coefficients[kMaxCoefficients];  // a0, then a_k, b_k

float mapDepth(float t) { return clamp((t - map.begin) / (map.end - map.begin), 0.0, 1.0); }

// Jansen and Bavoil 2010, eq. 5 and 6, for extinction spread evenly over a stretch.
void takePiece(float t0, float t1, vec3 depth, uint id) {
    float middle = mapDepth(0.5 * (t0 + t1)), width = mapDepth(t1) - mapDepth(t0);
    coefficients[0] += 2.0 * depth;
    for (uint k = 1u; 2u * k < map.count; ++k) {
        float w = kTwoPi * float(k), half_ = 0.5 * w * width;
        float spread = half_ > 1e-3 ? sin(half_) / half_ : 1.0;
        coefficients[2u * k - 1u] += (2.0 * cos(w * middle) * spread) * depth;
        coefficients[2u * k] += (2.0 * sin(w * middle) * spread) * depth;
        ++shadowIterations;
    }
}

void takeSurface(float t, vec3 transmittance, uint id) {
    takePiece(t, t, -log(max(transmittance, vec3(1e-6))), id);
}

bool hasRoom(uint pieces) { return true; }

void finishPieces(bool isLast) {}

#include "../common/walk.glsl"

void main() {
    map = ShadowMapRef(push.map).map;
    BuildTexel b = findBuildTexel(map, gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x,
                                  gl_LocalInvocationIndex);
    if (!b.isInside) return;
    uint from = beginRound(push, b.index);
    if (from == kAllCasters) return;
    for (uint i = 0u; i < kMaxCoefficients; ++i) coefficients[i] = vec3(0);
    uint next =
        walkCasters(map, b.tile, mapRay(map, b.face, vec2(b.texel) + 0.5), from, false);
    for (uint i = 0u; i < map.count; ++i)
        for (uint c = 0u; c < map.channels; ++c) {
            uint at = (b.index * map.count + i) * map.channels + c;
            float before = from > 0u ? Coefficients(push.target).at[at] : 0.0;
            Coefficients(push.target).at[at] = before + coefficients[i][c];
        }
    endRound(push, b.index, next);
}
