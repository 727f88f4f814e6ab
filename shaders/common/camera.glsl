// SPDX-License-Identifier: Apache-2.0
// From pixels to rays; the same definition as scene::CameraFrame.
#ifndef BRUME_COMMON_CAMERA_GLSL
#define BRUME_COMMON_CAMERA_GLSL
#include "bindings.glsl"
#include "real.glsl"

struct Ray {
    vec3 origin;     // relative to the camera; 0 in perspective
    vec3 direction;  // unit
};

// The same ray, finer.
struct RealRay {
    Real3 origin, direction;
};

// `position`: pixels from the top-left corner; centres at + 0.5.
Ray makeRay(vec2 position) {
    precise vec2 s = vec2(2.0 * position.x / float(frame.size.x) - 1.0,
                          1.0 - 2.0 * position.y / float(frame.size.y)) *
                         vec2(frame.extentX, frame.extentY) +
                     vec2(frame.centerX, frame.centerY);
    precise vec3 offset = s.x * frame.right + s.y * frame.up;
    Ray ray;
    ray.origin = hasParallelRays() ? offset : vec3(0);
    ray.direction = hasParallelRays() ? frame.forward : normalize(frame.forward + offset);
    return ray;
}

RealRay makeRealRay(vec2 position) {
    precise Real2 s = Real2(Real(2) * Real(position.x) / Real(frame.size.x) - Real(1),
                            Real(1) - Real(2) * Real(position.y) / Real(frame.size.y)) *
                      Real2(makeReal(frame.extentX, frame.extentXLo),
                            makeReal(frame.extentY, frame.extentYLo)) +
               Real2(makeReal(frame.centerX, frame.centerXLo),
                     makeReal(frame.centerY, frame.centerYLo));
    Real3 offset = s.x * makeReal(frame.right, frame.rightLo) + s.y * makeReal(frame.up, frame.upLo);
    Real3 forward = makeReal(frame.forward, frame.forwardLo);
    Real3 towards = forward + offset;
    RealRay ray;
    ray.origin = hasParallelRays() ? offset : Real3(0);
    ray.direction =
        hasParallelRays() ? forward : towards / sqrt(dot(towards, towards));
    return ray;
}

// Clip position for the rasteriser: reversed depth, infinite in perspective.
vec4 clipFromRelative(vec3 position) {
    vec3 view =
        vec3(dot(position, frame.right), dot(position, frame.up), dot(position, frame.forward));
    view.xy -= vec2(frame.centerX, frame.centerY) * (hasParallelRays() ? 1.0 : view.z);
    if (hasParallelRays())
        return vec4(view.x / frame.extentX, -view.y / frame.extentY,
                    (frame.far - view.z) / (frame.far - frame.near), 1.0);
    return vec4(view.x / frame.extentX, -view.y / frame.extentY, frame.near, view.z);
}

#endif
