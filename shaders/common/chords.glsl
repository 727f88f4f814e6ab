// SPDX-License-Identifier: Apache-2.0
// Where a ray enters and leaves a medium, as finely as the device can. A ray that misses has a
// chord of length 0: whoever has stored it meets both ends or none.
#ifndef BRUME_COMMON_CHORDS_GLSL
#define BRUME_COMMON_CHORDS_GLSL
#include "camera.glsl"

// Half the length of a chord (0: missed) and the distance of its middle.
struct SphereChord {
    Real middle, reach;
};

SphereChord findSphereChord(RealRay ray, SphereData sphere) {
    precise Real3 offset = makeReal(sphere.center, sphere.centerLo) - ray.origin;
    precise Real middle = dot(offset, ray.direction);
    precise Real3 perpendicular = offset - middle * ray.direction;
    precise Real h2 = Real(sphere.radius) * Real(sphere.radius) - dot(perpendicular, perpendicular);
    return SphereChord(middle, sqrt(max(h2, Real(0))));
}

// Begin and end, not before the ray's own begin.
Real2 clipChord(Real enter, Real leave) {
    enter = max(enter, Real(0));
    return Real2(enter, max(leave, enter));
}

Real2 sphereChord(RealRay ray, SphereData sphere) {
    SphereChord chord = findSphereChord(ray, sphere);
    return clipChord(chord.middle - chord.reach, chord.middle + chord.reach);
}

// Box [0, size] in its local coordinates. A ray in a face's plane misses (half-open cells).
Real2 boxChord(RealRay ray, BoxData box, VolumeData volume) {
    RealMat3 indexFromWorld = RealMat3(volume.indexFromWorld);
    Real3 origin = indexFromWorld * (ray.origin - makeReal(box.corner, box.cornerLo));
    Real3 direction = indexFromWorld * ray.direction;
    Real enter = Real(0), leave = Real(3e38);
    for (int axis = 0; axis < 3; ++axis) {
        Real o = origin[axis], d = direction[axis], s = Real(box.size[axis]);
        bool isParallel = abs(d) < Real(1e-30);
        bool isInside = o >= Real(0) && o < s;
        Real divisor = isParallel ? Real(1) : d;
        precise Real a = -o / divisor, b = (s - o) / divisor;
        enter = max(enter, isParallel ? Real(0) : min(a, b));
        leave = min(leave, isParallel ? (isInside ? leave : Real(0)) : max(a, b));
    }
    return clipChord(enter, leave);
}

#endif
