// SPDX-License-Identifier: Apache-2.0
// Media marched at fixed steps; C++ and GLSL.
#ifndef BRUME_SHADERS_OIT_MARCH_H
#define BRUME_SHADERS_OIT_MARCH_H
#include "../../common/shared.h"

BRUME_STRUCTS_BEGIN

struct MarchPush {
    uint64_t sphereOffsets, spherePairs;  // uint[tiles + 1], uint[]
    uint64_t boxOffsets, boxPairs;
    uint64_t counters;  // MarchCounters
    float step;         // voxels; of spheres: eighths of the radius
    float epsilon;      // pixels stop at transmittances below it
};

struct MarchCounters {
    uint steps;      // of all pixels
    uint exhausted;  // pixels at which the device may have ended the loops
};

// Own bindings.
BRUME_CONST uint kBindingMarchResult = 8u;  // RGBA32F

BRUME_STRUCTS_END

#ifdef __cplusplus
static_assert(sizeof(brume::shader::MarchPush) == 48);
#endif
#endif
