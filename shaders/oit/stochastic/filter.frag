// SPDX-License-Identifier: Apache-2.0
// Takes noise out of what the layers send: a cross-bilateral filter, guided by what has no noise:
// the optical depth of all layers, the sum of their radiances whatever hides them, and the distance
// of what is opaque. What lies behind stays as sharp as it is.
// Source: E. Eisemann, F. Durand: "Flash Photography Enhancement via Intrinsic Relighting", SIGGRAPH
// 2004, DOI 10.1145/1015706.1015778 (the filter); the guides are ours.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "estimate.glsl"

layout(constant_id = kEstimateRadius) const uint kRadius = 2u;
layout(binding = kBindingStochasticLayers) uniform sampler2D layers;
layout(location = 0) out vec4 result;

// Relative differences of the guides that take a weight to exp(-1/2); chosen by us.
const float kGuideTolerance = 0.1;
const float kDepthTolerance = 0.02;

float relative(float a, float b) { return abs(a - b) / max(max(a, b), 1e-6); }

struct Guide {
    vec2 sums;    // optical depth, radiance
    float limit;  // m, where something opaque is
};

Guide makeGuide(ivec2 pixel, vec4 total) {
    return Guide(vec2(total.r + total.g + total.b, total.a),
                 min(texelFetch(opaqueT, pixel, 0).x, 1e18));
}

float agreement(Guide a, Guide b) {
    vec3 d = vec3(relative(a.sums.x, b.sums.x), relative(a.sums.y, b.sums.y),
                  relative(a.limit, b.limit)) /
             vec3(kGuideTolerance, kGuideTolerance, kDepthTolerance);
    return exp(-0.5 * dot(d, d));
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(totals, 0) - 1;
    vec4 total = texelFetch(totals, pixel, 0);
    vec3 background = texelFetch(opaqueColor, pixel, 0).rgb;
    if (total == vec4(0)) {
        result = vec4(background, 1.0);
        return;
    }
    Guide own = makeGuide(pixel, total);
    int radius = int(kRadius);
    float spread = 2.0 / float(radius * radius);  // a standard deviation of half the radius
    vec3 radiance = vec3(0), loss = vec3(0);
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x) {
            ivec2 tap = pixel + ivec2(x, y);
            if (any(lessThan(tap, ivec2(0))) || any(greaterThan(tap, last))) continue;
            vec4 there = texelFetch(totals, tap, 0);
            float w = exp(-spread * float(x * x + y * y)) * agreement(own, makeGuide(tap, there));
            radiance += w * texelFetch(layers, tap, 0).rgb;
            loss += w * max(lossOf(there.rgb), vec3(1e-7));
        }
    vec3 mean = radiance / loss;  // the pixel itself has a weight of 1
    result = vec4(mean * max(lossOf(total.rgb), vec3(1e-7)) + exp(-total.rgb) * background, 1.0);
}
