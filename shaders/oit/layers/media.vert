// SPDX-License-Identifier: Apache-2.0
// A quad around each medium: six vertices, pulled. Spheres first, then boxes, or in a given order.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/bindings.glsl"
#include "../../common/bounds.glsl"
#include "../../gpu/address.glsl"
#include "layers.h"

layout(binding = kBindingSpheres, scalar) readonly buffer Spheres { SphereData spheres[]; };
layout(binding = kBindingBoxes, scalar) readonly buffer Boxes { BoxData boxes[]; };
layout(binding = kBindingVolumes, scalar) readonly buffer Volumes { VolumeData volumes[]; };
layout(push_constant, scalar) uniform Push { LayerPush push; };

// The medium itself goes along: fetching it in every fragment costs nearly twice as much.
layout(location = 0) flat out vec4 centerRadius;
layout(location = 1) flat out vec4 tintDensity;
layout(location = 2) flat out uvec4 kind;  // medium, profile, 1 + index of the box (0: a sphere), id
layout(location = 3) flat out uint shares;

void main() {
    uint slot = gl_VertexIndex / 6;
    uint corner = gl_VertexIndex % 6;
    uint index = push.order != 0ul ? UintArray(push.order).at[slot] : slot;
    Bounds bounds = kNowhere;
    centerRadius = tintDensity = vec4(0);
    kind = uvec4(0);
    shares = kNoShares;
    if (index < frame.sphereCount) {
        SphereData sphere = spheres[index];
        centerRadius = vec4(sphere.center, sphere.radius);
        tintDensity = vec4(sphere.tint, sphere.density);
        kind = uvec4(sphere.medium, sphere.profile, 0u, sphere.id);
        shares = sphere.shares;
        if (sphere.radius > 0.0 && sphere.density > 0.0)
            bounds = sphereBounds(sphere.center, sphere.radius);
    } else {
        BoxData box = boxes[index - frame.sphereCount];
        kind = uvec4(volumes[box.volume].medium, 0u, 1u + index - frame.sphereCount, ~index);
        bounds = boxBounds(box, volumes[box.volume]);
    }
    // Two triangles: 0 1 2, 2 1 3; a hundredth of a pixel more than the bounds, or the snapping of
    // vertices to sub-pixels loses silhouettes.
    uint c = corner < 3u ? corner : corner == 3u ? 2u : corner == 4u ? 1u : 3u;
    vec2 margin = 0.04 / vec2(frame.size);
    vec2 extent = vec2(frame.extentX, frame.extentY);
    vec2 center = vec2(frame.centerX, frame.centerY);
    vec2 lo = max((bounds.lo - center) / extent - margin, vec2(-1.1)),
         hi = min((bounds.hi - center) / extent + margin, vec2(1.1));
    vec2 p = vec2((c & 1u) != 0u ? hi.x : lo.x, (c & 2u) != 0u ? hi.y : lo.y);
    bool isDrawn = bounds.isVisible && all(lessThan(lo, hi));
    gl_Position = isDrawn ? vec4(p.x, -p.y, 0.5, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}
