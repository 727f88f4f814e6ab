// SPDX-License-Identifier: Apache-2.0
// The tiles that bounds on the image plane touch.
#ifndef BRUME_OIT_MEDIA_BINS_RECT_GLSL
#define BRUME_OIT_MEDIA_BINS_RECT_GLSL
#include "../../common/bounds.glsl"

const uvec2 kNoRect = uvec2(1u, 0u);

uvec2 tileRect(Bounds bounds) {
    if (!bounds.isVisible) return kNoRect;
    const float kMargin = 0.02;  // pixels; covers the rounding of the projection
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

#endif
