// SPDX-License-Identifier: Apache-2.0
// Where a ray enters and leaves a medium, in the forms that keep their digits in fp32. `precise`:
// a pass that counts and a pass that stores must decide alike.
#ifndef BRUME_COMMON_INTERSECT_GLSL
#define BRUME_COMMON_INTERSECT_GLSL

// Begin (not before the ray's) and end of the chord in a sphere, and the square of half its length;
// where that is not above 0, the ray misses, and both are the place where it comes nearest.
// Perpendicular form: the textbook b^2 - c loses most hits of a small sphere far away.
float findChord(vec3 origin, vec3 direction, vec3 center, float radius, out vec2 t) {
    precise vec3 offset = center - origin;
    precise float middle = dot(offset, direction);
    precise vec3 perpendicular = offset - middle * direction;
    precise float h2 = radius * radius - dot(perpendicular, perpendicular);
    precise float h = sqrt(max(h2, 0.0));
    precise float enter = max(middle - h, 0.0), leave = middle + h;
    t = vec2(enter, leave);
    return h2;
}

// False where the ray misses; tangent within rounding is a miss.
bool intersectSphere(vec3 origin, vec3 direction, vec3 center, float radius, out vec2 t) {
    return findChord(origin, direction, center, radius, t) > 0.0 && t.y > t.x;
}

// Whether a finer ray than this one may hit: true for every hit, and for what rounding may have
// made a miss.
bool mayHitSphere(vec3 origin, vec3 direction, vec3 center, float radius, out vec2 t) {
    float h2 = findChord(origin, direction, center, radius, t);
    precise vec3 offset = abs(center - origin);
    precise float reach = offset.x + offset.y + offset.z;
    precise float slack = 1e-6 * radius * (radius + reach), end = t.y + 2e-6 * reach;
    return h2 + slack > 0.0 && end > t.x;
}

// As mayHitSphere().
bool mayHitBox(vec3 origin, vec3 direction, vec3 size, out vec2 t) {
    t = vec2(0.0, 3.0e38);
    precise vec2 wide = t;
    bool hit = true;
    precise vec3 slack = 1e-6 * (abs(origin) + size);
    for (int axis = 0; axis < 3; ++axis) {
        float o = origin[axis], d = direction[axis], s = size[axis];
        if (abs(d) < 1e-30) {
            hit = hit && o >= -slack[axis] && o <= s + slack[axis];
        } else {
            precise float a = -o / d, b = (s - o) / d, more = slack[axis] / abs(d);
            t = vec2(max(t.x, min(a, b)), min(t.y, max(a, b)));
            wide = vec2(max(wide.x, min(a, b) - more), min(wide.y, max(a, b) + more));
        }
    }
    return hit && wide.y > wide.x;
}

// `origin` and `direction` in the box's local coordinates, box [0, size]. A ray in a face's plane
// misses (half-open cells); no 0 * inf.
bool intersectBox(vec3 origin, vec3 direction, vec3 size, out vec2 t) {
    t = vec2(0.0, 3.0e38);
    bool hit = true;
    for (int axis = 0; axis < 3; ++axis) {
        float o = origin[axis], d = direction[axis], s = size[axis];
        if (abs(d) < 1e-30) {
            hit = hit && o >= 0.0 && o < s;
        } else {
            precise float a = -o / d, b = (s - o) / d;
            t.x = max(t.x, min(a, b));
            t.y = min(t.y, max(a, b));
        }
    }
    return hit && t.y > t.x;
}

#endif
