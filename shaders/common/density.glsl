// SPDX-License-Identifier: Apache-2.0
// The density of media along a ray.
#ifndef BRUME_COMMON_DENSITY_GLSL
#define BRUME_COMMON_DENSITY_GLSL
#include "chords.glsl"

layout(buffer_reference, scalar) readonly buffer BrickValues { float at[]; };

// The ray in the local coordinates of a box, from some position on.
struct LocalRay {
    vec3 origin, direction;
};

LocalRay localRay(RealRay ray, BoxData box, VolumeData volume, Real position) {
    Real3 fromCorner =
        (ray.origin - makeReal(box.corner, box.cornerLo)) + ray.direction * position;
    return LocalRay(volume.indexFromWorld * vec3(fromCorner),
                    volume.indexFromWorld * vec3(ray.direction));
}

// The next offset behind `offset` at which the ray crosses a plane between cells.
float nextPlane(BoxData box, LocalRay local, float offset) {
    float nearest = 1e30;
    for (int axis = 0; axis < 3; ++axis) {
        float o = local.origin[axis], d = local.direction[axis], size = box.size[axis];
        if (abs(d) < 1e-30) continue;
        if (box.kind == kBoxBrick) {
            float cell = floor(o + d * offset), step = d > 0.0 ? 1.0 : -1.0;
            float plane = d > 0.0 ? cell + 1.0 : ceil(o + d * offset) - 1.0;
            float t = (plane - o) / d;
            // Standing on the plane within rounding: take the one behind it.
            float slack = 2e-6 / abs(d) + 2e-7 * offset;
            if (t <= offset + slack) t = (plane + step - o) / d;
            nearest = min(nearest, t);
        } else if (box.kind == kBoxSoft) {
            float inner = (1.0 - o) / d, outer = (size - 1.0 - o) / d;
            float slack = 2e-7 * offset;
            if (inner > offset + slack) nearest = min(nearest, inner);
            if (outer > offset + slack) nearest = min(nearest, outer);
        }
    }
    return nearest;
}

// Values at the corners of the cell around local point `p`, x fastest.
void loadCell(BoxData box, vec3 p, out vec4 low, out vec4 high, out vec3 cell) {
    cell = clamp(floor(p), vec3(0), vec3(7));
    uvec3 c = uvec3(cell);
    uint base = box.valueOffset + (c.z * 9u + c.y) * 9u + c.x;
    BrickValues values = BrickValues(frame.brickValues);
    low = vec4(values.at[base], values.at[base + 1u], values.at[base + 9u], values.at[base + 10u]);
    high = vec4(values.at[base + 81u], values.at[base + 82u], values.at[base + 90u],
                values.at[base + 91u]);
}

float trilinear(vec4 low, vec4 high, vec3 f) {
    vec4 z = mix(low, high, f.z);
    vec2 y = mix(z.xy, z.zw, f.y);
    return mix(y.x, y.y, f.x);
}

// A box's density along a ray within one cell: at(offset) = boxDensity().
struct BoxDensity {
    LocalRay local;
    vec4 low, high;  // brick: the cell's corners
    vec3 cell;
    vec3 size;
    uint kind;
    float value;
};

// `middle`: any offset inside the cell.
BoxDensity makeBoxDensity(BoxData box, LocalRay local, float middle) {
    BoxDensity density;
    density.local = local;
    density.size = box.size;
    density.kind = box.kind;
    density.value = box.value;
    if (box.kind == kBoxBrick)
        loadCell(box, local.origin + local.direction * middle, density.low, density.high,
                 density.cell);
    return density;
}

float boxDensity(BoxDensity density, float offset) {
    vec3 p = density.local.origin + density.local.direction * offset;
    if (density.kind == kBoxBrick)
        return trilinear(density.low, density.high, clamp(p - density.cell, 0.0, 1.0));
    vec3 ramp = clamp(min(p, density.size - p), 0.0, 1.0);
    return density.value * (density.kind == kBoxSoft ? ramp.x * ramp.y * ramp.z : 1.0);
}

// A sphere's density along a ray: at(offset) = sphereDensity(). From the distances to both ends of
// the chord, so that it keeps its digits near them.
struct SphereDensity {
    float behind, ahead;  // from the position to the ends of the chord
    float smoothScale;    // density / R^4, or 0
    float constant;       // density, or 0
};

SphereDensity makeSphereDensity(RealRay ray, SphereData sphere, Real position) {
    SphereChord chord = findSphereChord(ray, sphere);
    bool isConstant = sphere.profile == kProfileConstant;
    float r2 = sphere.radius * sphere.radius;
    return SphereDensity(float(position - (chord.middle - chord.reach)),
                         float((chord.middle + chord.reach) - position),
                         isConstant ? 0.0 : sphere.density / (r2 * r2),
                         isConstant ? sphere.density : 0.0);
}

float sphereDensity(SphereDensity density, float offset) {
    float q = max((density.behind + offset) * (density.ahead - offset), 0.0);
    return density.constant + density.smoothScale * q * q;
}

#endif
