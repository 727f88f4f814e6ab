// SPDX-License-Identifier: Apache-2.0
// How far the mean of a pixel's passes may be off, by how they differ.
#ifndef BRUME_OIT_STOCHASTIC_VARIANCE_GLSL
#define BRUME_OIT_STOCHASTIC_VARIANCE_GLSL

layout(binding = kBindingStochasticMeans) uniform sampler2D means;
layout(binding = kBindingStochasticSquares) uniform sampler2D squares;

// Sample variance of what single passes show.
vec3 passVariance(ivec2 pixel) {
    vec4 sum = texelFetch(means, pixel, 0);
    vec3 excess = texelFetch(squares, pixel, 0).rgb - sum.rgb * (sum.rgb / sum.a);
    return max(excess, vec3(0)) / max(sum.a - 1.0, 1.0);
}

// A few passes say little about their variance: the pixel's eight neighbours are heard as well.
bool isErrorReached(ivec2 pixel) {
    ivec2 last = textureSize(means, 0) - 1;
    vec3 variance = vec3(0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            variance += passVariance(clamp(pixel + ivec2(x, y), ivec2(0), last)) * (1.0 / 9.0);
    vec4 sum = texelFetch(means, pixel, 0);
    // Absolute up to a radiance of 1, relative above.
    vec3 allowed = kError * max(sum.rgb / sum.a, vec3(1));
    return all(lessThanEqual(variance, allowed * allowed * sum.a));
}

#endif
