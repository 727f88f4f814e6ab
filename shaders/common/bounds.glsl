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

// `view`: the centre along right, up and forward of the viewer.
Bounds sphereBoundsInView(vec3 view, float radius, bool isOrthographic) {
    // A little larger: rays and projection round differently.
    float r = radius * 1.00001 + 1e-6 * length(view);
    if (view.z + r <= 0.0) return kNowhere;
    if (isOrthographic) return Bounds(view.xy - r, view.xy + r, true);
    vec2 x = tangentSlopes(view.x, view.z, r), y = tangentSlopes(view.y, view.z, r);
    return Bounds(vec2(x.x, y.x), vec2(x.y, y.y), true);
}

// Of a convex thing, corner by corner: begin, add each, finish.
struct CornerBounds {
    vec2 lo, hi;
    float nearest, farthest;
};

CornerBounds beginCorners() { return CornerBounds(vec2(1e30), vec2(-1e30), 1e30, -1e30); }

void addCorner(inout CornerBounds sum, vec3 view, bool isOrthographic) {
    sum.nearest = min(sum.nearest, view.z);
    sum.farthest = max(sum.farthest, view.z);
    vec2 s = isOrthographic ? view.xy : view.xy / max(view.z, 1e-30);
    sum.lo = min(sum.lo, s);
    sum.hi = max(sum.hi, s);
}

Bounds finishCorners(CornerBounds sum, bool isOrthographic) {
    if (sum.farthest <= 0.0) return kNowhere;
    if (!isOrthographic && sum.nearest <= 1e-4 * sum.farthest) return kWholeScreen;
    vec2 slack = 1e-6 * (abs(sum.lo) + abs(sum.hi));
    return Bounds(sum.lo - slack, sum.hi + slack, true);
}

vec3 boxCorner(BoxData box, VolumeData volume, uint corner) {
    vec3 local = box.size * vec3(corner & 1u, corner >> 1u & 1u, corner >> 2u);
    return box.corner + volume.worldFromIndex * local;
}

vec3 cameraCoordinates(vec3 p) {
    return vec3(dot(p, frame.right), dot(p, frame.up), dot(p, frame.forward));
}

Bounds sphereBounds(vec3 center, float radius) {
    return sphereBoundsInView(cameraCoordinates(center), radius, hasParallelRays());
}

Bounds boxBounds(BoxData box, VolumeData volume) {
    bool isOrthographic = hasParallelRays();
    CornerBounds corners = beginCorners();
    for (uint c = 0u; c < 8u; ++c)
        addCorner(corners, cameraCoordinates(boxCorner(box, volume, c)), isOrthographic);
    return finishCorners(corners, isOrthographic);
}

#endif
