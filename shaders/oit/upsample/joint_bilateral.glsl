// SPDX-License-Identifier: Apache-2.0
// Reads targets of low resolution at full resolution: the four texels around a pixel, each by its
// distance and by how well the opaque depth at its centre agrees with the pixel's, so that smoke
// keeps clean edges where it meets opaque geometry.
// Source: J. Kopf, M. Cohen, D. Lischinski, M. Uyttendaele: "Joint Bilateral Upsampling", SIGGRAPH
// 2007, DOI 10.1145/1275808.1276497, with the depth as key.
#ifndef BRUME_OIT_UPSAMPLE_JOINT_BILATERAL_GLSL
#define BRUME_OIT_UPSAMPLE_JOINT_BILATERAL_GLSL

// Halves the weight when the depths differ by this share; chosen by us.
const float kDepthTolerance = 0.02;

struct LowTexels {
    ivec2 at[4];
    float weight[4];  // their sum is 1
};

// `key`: distances at full resolution; `pixel`: of them; `scale`: pixels per edge of a low texel.
LowTexels findLowTexels(sampler2D key, ivec2 pixel, uint scale) {
    ivec2 size = textureSize(key, 0);
    ivec2 lowSize = (size + int(scale) - 1) / int(scale);
    vec2 position = (vec2(pixel) + 0.5) / float(scale) - 0.5;
    ivec2 corner = ivec2(floor(position));
    vec2 f = position - vec2(corner);
    float own = min(texelFetch(key, pixel, 0).x, 1e18), total = 0.0;
    LowTexels texels;
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2(i & 1, i >> 1);
        texels.at[i] = clamp(corner + step, ivec2(0), lowSize - 1);
        // Where the low texel looked for something opaque.
        ivec2 centre = min(ivec2((vec2(texels.at[i]) + 0.5) * float(scale)), size - 1);
        float other = min(texelFetch(key, centre, 0).x, 1e18);
        float difference = abs(own - other) / max(min(own, other), 1e-6);
        vec2 bilinear = mix(1.0 - f, f, vec2(step)) + 1e-3;
        texels.weight[i] =
            bilinear.x * bilinear.y * max(exp2(-min(difference / kDepthTolerance, 60.0)), 1e-7);
        total += texels.weight[i];
    }
    for (int i = 0; i < 4; ++i) texels.weight[i] /= total;
    return texels;
}

vec4 readLow(sampler2D low, LowTexels texels) {
    vec4 sum = vec4(0);
    for (int i = 0; i < 4; ++i) sum += texels.weight[i] * texelFetch(low, texels.at[i], 0);
    return sum;
}

#endif
