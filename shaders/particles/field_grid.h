// SPDX-License-Identifier: Apache-2.0
// Grids of values in space, sampled trilinearly by the simulator: dense boxes of floats, all in one
// array. A voxel's value sits at its integer index; staggered components sit half a voxel below.
// Limits: positions count in floats from the first voxel of the box.
#ifndef BRUME_SHADERS_PARTICLES_FIELD_GRID_H
#define BRUME_SHADERS_PARTICLES_FIELD_GRID_H

#include "../common/replayable_math.h"

BRUME_STRUCTS_BEGIN
BRUME_CONST uint kBindingFieldValues = 22u;  // float[], of the simulator's passes
BRUME_STRUCTS_END

// The values are an argument in C++ and a buffer in GLSL, which shaders without grids never bind.
#define BRUME_FIELD_VALUES fieldValues
#ifdef __cplusplus
#define BRUME_FIELDS_PARAMETER const float *fieldValues,
#define BRUME_FIELDS_ARGUMENT fieldValues,
#else
#define BRUME_FIELDS_PARAMETER
#define BRUME_FIELDS_ARGUMENT
layout(set = 0, binding = kBindingFieldValues, scalar) readonly buffer FieldValuesBlock {
    float fieldValues[];
};
#endif

BRUME_STRUCTS_BEGIN

struct FieldGrid {
    vec3 axisX;   // index position = origin + axisX x + axisY y + axisZ z, from the first voxel
    vec3 axisY;
    vec3 axisZ;
    vec3 origin;
    uvec3 size;   // voxels
    uint firstValue;      // x fastest, components side by side
    uint componentCount;  // 1 or 3
    uint isStaggered;
    float outside;        // every component, outside the box
};

BRUME_SHARED vec3 fieldIndex(FieldGrid grid, vec3 position) {
    BRUME_PRECISE vec3 index = grid.origin + grid.axisX * position.x + grid.axisY * position.y +
                               grid.axisZ * position.z;
    return index;
}

/// The value of voxel (x, y, z), which may lie outside.
BRUME_SHARED float fieldVoxel(BRUME_FIELDS_PARAMETER FieldGrid grid, int x, int y, int z,
                              uint component) {
    bool isInside = x >= 0 && y >= 0 && z >= 0 && uint(x) < grid.size.x && uint(y) < grid.size.y &&
                    uint(z) < grid.size.z;
    uint voxel = isInside ? (uint(z) * grid.size.y + uint(y)) * grid.size.x + uint(x) : 0u;
    float value =
        BRUME_FIELD_VALUES[grid.firstValue + voxel * grid.componentCount + component];
    return isInside ? value : grid.outside;
}

BRUME_SHARED float mixReplayable(float a, float b, float part) {
    BRUME_PRECISE float result = a + (b - a) * part;
    return result;
}

/// One component at an index position.
BRUME_SHARED float sampleComponent(BRUME_FIELDS_PARAMETER FieldGrid grid, vec3 index,
                                   uint component) {
    // Also keeps what is converted to integers small. NaN fails the comparisons.
    bool isNear = index.x > -1.0f && index.y > -1.0f && index.z > -1.0f &&
                  index.x < float(grid.size.x) && index.y < float(grid.size.y) &&
                  index.z < float(grid.size.z);
    BRUME_PRECISE vec3 p = isNear ? index : vec3(0.0f);
    BRUME_PRECISE vec3 low = vec3(floor(p.x), floor(p.y), floor(p.z));
    BRUME_PRECISE vec3 part = p - low;
    int x = int(low.x);
    int y = int(low.y);
    int z = int(low.z);
    float near = 0.0f;
    float far = 0.0f;
    for (int dz = 0; dz < 2; ++dz) {
        float bottom = mixReplayable(
            fieldVoxel(BRUME_FIELDS_ARGUMENT grid, x, y, z + dz, component),
            fieldVoxel(BRUME_FIELDS_ARGUMENT grid, x + 1, y, z + dz, component), part.x);
        float top = mixReplayable(
            fieldVoxel(BRUME_FIELDS_ARGUMENT grid, x, y + 1, z + dz, component),
            fieldVoxel(BRUME_FIELDS_ARGUMENT grid, x + 1, y + 1, z + dz, component), part.x);
        near = far;
        far = mixReplayable(bottom, top, part.y);
    }
    float value = mixReplayable(near, far, part.z);
    return isNear ? value : grid.outside;
}

/// A grid of scalars at a place in effect space.
BRUME_SHARED float sampleScalarField(BRUME_FIELDS_PARAMETER FieldGrid grid, vec3 position) {
    return sampleComponent(BRUME_FIELDS_ARGUMENT grid, fieldIndex(grid, position), 0u);
}

/// A grid of vectors at a place in effect space.
BRUME_SHARED vec3 sampleVectorField(BRUME_FIELDS_PARAMETER FieldGrid grid, vec3 position) {
    BRUME_PRECISE vec3 index = fieldIndex(grid, position);
    BRUME_PRECISE float shift = grid.isStaggered != 0u ? 0.5f : 0.0f;
    BRUME_PRECISE vec3 shifted = index + shift;
    return vec3(
        sampleComponent(BRUME_FIELDS_ARGUMENT grid, vec3(shifted.x, index.y, index.z), 0u),
        sampleComponent(BRUME_FIELDS_ARGUMENT grid, vec3(index.x, shifted.y, index.z), 1u),
        sampleComponent(BRUME_FIELDS_ARGUMENT grid, vec3(index.x, index.y, shifted.z), 2u));
}

/// The gradient of a grid of scalars in effect space, by differences over one voxel to both sides.
BRUME_SHARED vec3 fieldGradient(BRUME_FIELDS_PARAMETER FieldGrid grid, vec3 position) {
    BRUME_PRECISE vec3 p = fieldIndex(grid, position);
    BRUME_PRECISE vec3 q = p + 1.0f;
    BRUME_PRECISE vec3 o = p - 1.0f;
    BRUME_PRECISE vec3 above =
        vec3(sampleComponent(BRUME_FIELDS_ARGUMENT grid, vec3(q.x, p.y, p.z), 0u),
             sampleComponent(BRUME_FIELDS_ARGUMENT grid, vec3(p.x, q.y, p.z), 0u),
             sampleComponent(BRUME_FIELDS_ARGUMENT grid, vec3(p.x, p.y, q.z), 0u));
    BRUME_PRECISE vec3 below =
        vec3(sampleComponent(BRUME_FIELDS_ARGUMENT grid, vec3(o.x, p.y, p.z), 0u),
             sampleComponent(BRUME_FIELDS_ARGUMENT grid, vec3(p.x, o.y, p.z), 0u),
             sampleComponent(BRUME_FIELDS_ARGUMENT grid, vec3(p.x, p.y, o.z), 0u));
    BRUME_PRECISE vec3 twice = above - below;
    BRUME_PRECISE vec3 gradient =
        vec3(dotReplayable(grid.axisX, twice), dotReplayable(grid.axisY, twice),
             dotReplayable(grid.axisZ, twice)) *
        0.5f;
    return gradient;
}

BRUME_STRUCTS_END
#endif
