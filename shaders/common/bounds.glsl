// SPDX-License-Identifier: Apache-2.0
// Conservative bounds of media on the image plane.
#ifndef BRUME_COMMON_BOUNDS_GLSL
#define BRUME_COMMON_BOUNDS_GLSL
#include "bindings.glsl"

// Image plane coordinates: x to the right, y up, the image spans +-extent.
struct Bounds {
    vec2 lo, hi;
    bool isVisible;
};

const Bounds kWholeScreen = Bounds(vec2(-1e30), vec2(1e30), true);
const Bounds kNowhere = Bounds(vec2(0), vec2(0), false);

// Slopes position/depth of the two tangents from the eye to a circle around (x, z), radius r.
vec2 tangentSlopes(float x, float z, float r) {
    float d2 = x * x + z * z - r * r;
    if (d2 <= 0.0) return vec2(-1e30, 1e30);  // the eye is inside
    float t = sqrt(d2);
    float lowDepth = z * t + x * r, highDepth = z * t - x * r;
    return vec2(lowDepth > 0.0 ? (x * t - z * r) / lowDepth : -1e30,
                highDepth > 0.0 ? (x * t + z * r) / highDepth : 1e30);
}

Bounds sphereBounds(vec3 center, float radius) {
    vec3 view = vec3(dot(center, frame.right), dot(center, frame.up), dot(center, frame.forward));
    // A little larger: rays and projection round differently.
    float r = radius * 1.00001 + 1e-6 * length(view);
    if (view.z + r <= 0.0) return kNowhere;
    if (frame.orthographic != 0u) return Bounds(view.xy - r, view.xy + r, true);
    vec2 x = tangentSlopes(view.x, view.z, r), y = tangentSlopes(view.y, view.z, r);
    return Bounds(vec2(x.x, y.x), vec2(x.y, y.y), true);
}

Bounds boxBounds(BoxData box, VolumeData volume) {
    vec2 lo = vec2(1e30), hi = vec2(-1e30);
    float nearest = 1e30, farthest = -1e30;
    for (uint c = 0u; c < 8u; ++c) {
        vec3 local = box.size * vec3(c & 1u, c >> 1u & 1u, c >> 2u);
        vec3 p = box.corner + volume.worldFromIndex * local;
        vec3 view = vec3(dot(p, frame.right), dot(p, frame.up), dot(p, frame.forward));
        nearest = min(nearest, view.z);
        farthest = max(farthest, view.z);
        vec2 s = frame.orthographic != 0u ? view.xy : view.xy / max(view.z, 1e-30);
        lo = min(lo, s);
        hi = max(hi, s);
    }
    if (farthest <= 0.0) return kNowhere;
    if (frame.orthographic == 0u && nearest <= 1e-4 * farthest) return kWholeScreen;
    vec2 slack = 1e-6 * (abs(lo) + abs(hi));
    return Bounds(lo - slack, hi + slack, true);
}

#endif
