// SPDX-License-Identifier: Apache-2.0
// Conservative screen bounds of media, in tiles.
#ifndef BRUME_OIT_MEDIA_BINS_RECT_GLSL
#define BRUME_OIT_MEDIA_BINS_RECT_GLSL

const uvec2 kNoRect = uvec2(1u, 0u);

// Slopes position/depth of the two tangents from the eye to a circle around (x, z), radius r.
vec2 tangentSlopes(float x, float z, float r) {
    float d2 = x * x + z * z - r * r;
    if (d2 <= 0.0) return vec2(-1e30, 1e30);  // the eye is inside
    float t = sqrt(d2);
    float lowDepth = z * t + x * r, highDepth = z * t - x * r;
    return vec2(lowDepth > 0.0 ? (x * t - z * r) / lowDepth : -1e30,
                highDepth > 0.0 ? (x * t + z * r) / highDepth : 1e30);
}

// `lo`, `hi`: image plane coordinates, x to the right, y up, the image spans +-extent.
uvec2 tileRect(vec2 lo, vec2 hi) {
    const float kMargin = 0.02;  // pixels; covers the rounding of the projection
    vec2 size = vec2(frame.size);
    vec2 extent = vec2(frame.extentX, frame.extentY);
    vec2 first = (vec2(lo.x, -hi.y) / extent * 0.5 + 0.5) * size - kMargin;
    vec2 last = (vec2(hi.x, -lo.y) / extent * 0.5 + 0.5) * size + kMargin;
    if (any(lessThan(last, vec2(0))) || any(greaterThan(first, size))) return kNoRect;
    uvec2 a = uvec2(clamp(first, vec2(0), size - 1.0)) / kTileSize;
    uvec2 b = uvec2(clamp(last, vec2(0), size - 1.0)) / kTileSize;
    return uvec2(a.x | a.y << 16, b.x | b.y << 16);
}

uvec2 sphereRect(vec3 center, float radius) {
    vec3 view = vec3(dot(center, frame.right), dot(center, frame.up), dot(center, frame.forward));
    // A little larger: rays and projection round differently.
    float r = radius * 1.00001 + 1e-6 * length(view);
    if (view.z + r <= 0.0) return kNoRect;
    if (frame.orthographic != 0u) return tileRect(view.xy - r, view.xy + r);
    vec2 x = tangentSlopes(view.x, view.z, r), y = tangentSlopes(view.y, view.z, r);
    return tileRect(vec2(x.x, y.x), vec2(x.y, y.y));
}

uvec2 boxRect(BoxData box, VolumeData volume) {
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
    if (farthest <= 0.0) return kNoRect;
    if (frame.orthographic == 0u && nearest <= 1e-4 * farthest) return tileRect(vec2(-1e30), vec2(1e30));
    vec2 slack = 1e-6 * (abs(lo) + abs(hi));
    return tileRect(lo - slack, hi + slack);
}

#endif
