// SPDX-License-Identifier: Apache-2.0
// Adaptive: adds what one pass shows to the sums over all passes.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "estimate.glsl"

layout(binding = kBindingStochasticSum) uniform sampler2D sums;
layout(binding = kBindingStochasticWeights) uniform sampler2D weightSums;
layout(location = 0) out vec4 mean;
layout(location = 1) out vec4 square;
layout(location = 2) out vec4 sumOfAll;
layout(location = 3) out vec4 weightsOfAll;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    sumOfAll = texelFetch(sums, pixel, 0);
    weightsOfAll = kColoured ? texelFetch(weightSums, pixel, 0) : sumOfAll.aaaa;
    vec3 depth = texelFetch(totals, pixel, 0).rgb;
    vec3 shown = compose(estimateFrom(depth, sumOfAll.rgb, weightsOfAll.rgb), pixel);
    mean = vec4(shown, 1.0);
    square = vec4(shown * shown, 0.0);
}
