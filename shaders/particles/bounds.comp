#version 460
// SPDX-License-Identifier: Apache-2.0
// The box around each range of spheres: an invocation looks at a chunk of one range.
#extension GL_GOOGLE_include_directive : require
#include "bounds.h"

layout(local_size_x_id = 0) in;
layout(set = 0, binding = kBindingBoundedSpheres, scalar) readonly buffer SpheresBlock { SphereData spheres[]; };
layout(set = 0, binding = kBindingBoundedRanges, scalar) readonly buffer RangesBlock {
    BoundedFrame frame;
    BoundedRange ranges[];
};
layout(set = 0, binding = kBindingBounds, scalar) buffer BoundsBlock { uint bounds[]; };

/// The last range with firstChunk <= chunk.
uint findRange(uint chunk) {
    uint low = 0u;
    uint high = frame.ranges;
    for (uint i = 0u; i < 32u && high > low + 1u; ++i) {
        uint middle = low + (high - low) / 2u;
        bool isBelow = ranges[middle].firstChunk <= chunk;
        low = isBelow ? middle : low;
        high = isBelow ? high : middle;
    }
    return low;
}

void main() {
    uint chunk = gl_GlobalInvocationID.x +
                 gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
    if (chunk >= frame.chunks) return;
    uint index = findRange(chunk);
    BoundedRange range = ranges[index];
    uint begin = (chunk - range.firstChunk) * kBoundsChunk;
    uint end = min(begin + kBoundsChunk, range.count);
    vec3 lo = vec3(3.4e38);
    vec3 hi = vec3(-3.4e38);
    for (uint i = begin; i < end; ++i) {
        SphereData sphere = spheres[range.firstSphere + i];
        // Roundings, and what they have taken from the centre, widen the box.
        vec3 reach = vec3(sphere.radius) + abs(sphere.centerLo) +
                     3e-7 * (abs(sphere.center) + vec3(sphere.radius));
        bool isThere = sphere.radius > 0 && sphere.density > 0;
        lo = isThere ? min(lo, sphere.center - reach) : lo;
        hi = isThere ? max(hi, sphere.center + reach) : hi;
    }
    if (lo.x > hi.x) return;
    for (uint axis = 0u; axis < 3u; ++axis) {
        atomicMin(bounds[6u * index + axis], orderedKey(lo[axis]));
        atomicMin(bounds[6u * index + 3u + axis], ~orderedKey(hi[axis]));
    }
}
