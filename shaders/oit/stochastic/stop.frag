// SPDX-License-Identifier: Apache-2.0
// Adaptive: closes the pixels that are good enough to the layers of later passes, by a depth in
// front of everything.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "estimate.glsl"
#include "variance.glsl"

void main() {
    if (!isErrorReached(ivec2(gl_FragCoord.xy))) discard;
    gl_FragDepth = 1.0;
}
