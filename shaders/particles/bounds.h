// SPDX-License-Identifier: Apache-2.0
// Boxes around ranges of spheres; C++ and GLSL. Floats are ordered as integers, so that atomics find
// the least; with the largest inverted, both begin with all bits set.
#ifndef BRUME_SHADERS_PARTICLES_BOUNDS_H
#define BRUME_SHADERS_PARTICLES_BOUNDS_H

#include "../common/shared_math.h"
#include "../common/sphere.h"

BRUME_STRUCTS_BEGIN

BRUME_CONST uint kBoundsChunk = 256u;  // spheres of one invocation
BRUME_CONST uint kBoundsEmpty = 0xffffffffu;

BRUME_CONST uint kBindingBoundedSpheres = 0u;  // SphereData[]
BRUME_CONST uint kBindingBoundedRanges = 1u;   // BoundedFrame, then BoundedRange[]
BRUME_CONST uint kBindingBounds = 2u;          // uint[6] by range: keys of lo, inverted keys of hi

struct BoundedFrame {
    uint ranges;
    uint chunks;  // of all ranges
};

struct BoundedRange {
    uint firstSphere;
    uint count;
    uint firstChunk;  // chunks of the ranges before it
};

/// Rises with the float; NaN does not occur.
BRUME_SHARED uint orderedKey(float x) {
    uint bits = floatBitsToUint(x);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

BRUME_SHARED float fromOrderedKey(uint key) {
    return uintBitsToFloat((key & 0x80000000u) != 0u ? key & 0x7fffffffu : ~key);
}

BRUME_STRUCTS_END
#endif
