// SPDX-License-Identifier: Apache-2.0
// What lies behind all layers as it is seen through them: displaced and blurred.
#ifndef BRUME_OIT_WEIGHTED_BACKGROUND_GLSL
#define BRUME_OIT_WEIGHTED_BACKGROUND_GLSL

layout(constant_id = kResolveDiffusion) const bool kDiffusion = false;
layout(constant_id = kResolveRefraction) const bool kRefraction = false;
layout(constant_id = kResolveTaps) const uint kTaps = 24u;
layout(constant_id = kResolvePacked) const bool kPacked = false;
layout(binding = kBindingOpaqueColor) uniform sampler2D opaqueColor;
layout(binding = kBindingOpaqueT) uniform sampler2D opaqueT;
layout(binding = kBindingWeightedDepth) uniform sampler2D depthSums;
layout(binding = kBindingWeightedOffset) uniform sampler2D offsetSums;

ivec2 clampPixel(vec2 pixel) {
    return clamp(ivec2(floor(pixel)), ivec2(0), textureSize(opaqueColor, 0) - 1);
}

// Offsets are averaged by coverage, so that stacked panes do not run away; what lies before the
// refracting surface is not seen through it.
vec2 refract(vec2 pixel) {
    vec4 sum = texelFetch(offsetSums, ivec2(pixel), 0);
    if (kPacked) return pixel + sum.xy * kPackedOffset;  // no room for coverage and distance
    vec2 displaced = pixel + sum.xy / max(sum.z, 1.0);
    bool isBehind = texelFetch(opaqueT, clampPixel(displaced), 0).x * sum.z > sum.w;
    return isBehind ? displaced : pixel;
}

float blurAt(ivec2 pixel) {
    float variance = texelFetch(depthSums, pixel, 0).a;
    return kPacked ? kMaxBlur * sqrt(variance) : min(sqrt(variance), kMaxBlur);
}

// A tap counts when it lies within two standard deviations of both blurs: neither does a sharp
// thing before the pane bleed into its surroundings, nor does what touches the pane from behind.
void addTap(vec2 center, vec2 step, float blur, inout vec4 sum) {
    ivec2 tap = clampPixel(center + step);
    float r2 = dot(step, step), reach = 2.0 * min(blur, blurAt(tap));
    float w = r2 <= reach * reach ? exp(-0.5 * r2 / (blur * blur)) : 0.0;
    sum += w * vec4(texelFetch(opaqueColor, tap, 0).rgb, 1.0);
}

vec3 gather(vec2 center, float blur) {
    vec4 sum = vec4(texelFetch(opaqueColor, clampPixel(center), 0).rgb, 1.0);
    if (kTaps == 0u) {
        int radius = int(ceil(2.0 * blur));
        for (int y = -radius; y <= radius; ++y)
            for (int x = -radius; x <= radius; ++x)
                if (x != 0 || y != 0) addTap(center, vec2(x, y), blur, sum);
    } else {
        // Vogel's spiral: each tap stands for an equal area of the disk; the centre for one pixel.
        float area = 12.566370614359172 * blur * blur / float(kTaps);
        sum /= max(area, 1.0);
        for (uint i = 0u; i < kTaps; ++i) {
            float r = 2.0 * blur * sqrt((float(i) + 0.5) / float(kTaps));
            float angle = 2.399963229728653 * float(i);
            addTap(center, r * vec2(cos(angle), sin(angle)), blur, sum);
        }
    }
    return sum.rgb / sum.a;
}

vec3 backgroundAt(vec2 pixel) {
    if (kRefraction) pixel = refract(pixel);
    if (kDiffusion) {
        float blur = blurAt(ivec2(gl_FragCoord.xy));
        if (blur > 0.25) return gather(pixel, blur);
    }
    return texelFetch(opaqueColor, clampPixel(pixel), 0).rgb;
}

#endif
