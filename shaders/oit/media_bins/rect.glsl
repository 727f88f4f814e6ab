// SPDX-License-Identifier: Apache-2.0
// The tiles that media touch on the image plane.
#ifndef BRUME_OIT_MEDIA_BINS_RECT_GLSL
#define BRUME_OIT_MEDIA_BINS_RECT_GLSL
#include "../../common/bounds.glsl"

const uvec2 kNoRect = uvec2(1u, 0u);
const float kMargin = 0.02;  // pixels; covers the rounding of the projection

uvec2 tileRect(Bounds bounds) {
    if (!bounds.isVisible) return kNoRect;
    vec2 size = vec2(frame.size);
    vec2 extent = vec2(frame.extentX, frame.extentY);
    vec2 center = vec2(frame.centerX, frame.centerY);
    bounds.lo -= center, bounds.hi -= center;
    vec2 first = (vec2(bounds.lo.x, -bounds.hi.y) / extent * 0.5 + 0.5) * size - kMargin;
    vec2 last = (vec2(bounds.hi.x, -bounds.lo.y) / extent * 0.5 + 0.5) * size + kMargin;
    if (any(lessThan(last, vec2(0))) || any(greaterThan(first, size))) return kNoRect;
    uvec2 a = uvec2(clamp(first, vec2(0), size - 1.0)) / kTileSize;
    uvec2 b = uvec2(clamp(last, vec2(0), size - 1.0)) / kTileSize;
    return uvec2(a.x | a.y << 16, b.x | b.y << 16);
}

// Whether a sphere's centre (along right, up and forward of the camera) is farther from the ray
// through a tile's middle than its radius and the tile's other rays reach.
bool isBesideTile(vec3 view, float radius, uvec2 tile) {
    vec2 extent = vec2(frame.extentX, frame.extentY);
    vec2 middle = (vec2(tile) + 0.5) * float(kTileSize) / vec2(frame.size) * 2.0 - 1.0;
    vec2 ray = vec2(frame.centerX, frame.centerY) + vec2(middle.x, -middle.y) * extent;
    float halfTile = length((0.5 * float(kTileSize) + kMargin) * 2.0 * extent / vec2(frame.size));
    float r = radius * 1.00001 + 1e-6 * length(view);
    if (hasParallelRays()) return distance(view.xy, ray) > r + halfTile;
    vec3 direction = vec3(ray, 1.0);
    // |sin(a + b)| <= |sin(a)| + |sin(b)|, and the sine between two rays of a tile is at most its
    // half diagonal at distance 1 by the length of the ray to there.
    return length(cross(view, direction)) > r * length(direction) + halfTile * length(view);
}

#endif
