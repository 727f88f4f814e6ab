// SPDX-License-Identifier: Apache-2.0
// Textures of materials.
#ifndef BRUME_COMMON_TEXTURE_GLSL
#define BRUME_COMMON_TEXTURE_GLSL
#include "real.glsl"

// Bilinear, repeating; by hand, because filters round to 1/256 texel.
vec4 sampleTexture(sampler2D image, Real2 uv) {
    ivec2 size = textureSize(image, 0);
    // Coordinates that have overflowed are no numbers; clamped, they read some texel.
    Real2 position = clamp(uv - floor(uv), Real(0), Real(1)) * Real2(size) - Real(0.5);
    Real2 corner = floor(position);
    vec2 f = vec2(position - corner);
    ivec2 low = ivec2(corner);
    low = mix(low, size - 1, lessThan(low, ivec2(0)));
    ivec2 high = mix(low + 1, ivec2(0), equal(low, size - 1));
    return mix(mix(texelFetch(image, low, 0), texelFetch(image, ivec2(high.x, low.y), 0), f.x),
               mix(texelFetch(image, ivec2(low.x, high.y), 0), texelFetch(image, high, 0), f.x),
               f.y);
}

#endif
