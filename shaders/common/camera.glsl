// SPDX-License-Identifier: Apache-2.0
// From pixels to rays; the same definition as scene::CameraFrame.
#ifndef BRUME_COMMON_CAMERA_GLSL
#define BRUME_COMMON_CAMERA_GLSL
#include "bindings.glsl"

struct Ray {
    vec3 origin;     // relative to the camera; 0 in perspective
    vec3 direction;  // unit
};

// `position`: pixels from the top-left corner; centres at + 0.5.
Ray makeRay(vec2 position) {
    precise vec2 s = vec2(2.0 * position.x / float(frame.size.x) - 1.0,
                          1.0 - 2.0 * position.y / float(frame.size.y)) *
                     vec2(frame.extentX, frame.extentY);
    precise vec3 offset = s.x * frame.right + s.y * frame.up;
    Ray ray;
    ray.origin = frame.orthographic != 0u ? offset : vec3(0);
    ray.direction = frame.orthographic != 0u ? frame.forward : normalize(frame.forward + offset);
    return ray;
}

// Clip position for the rasteriser: reversed depth, infinite in perspective.
vec4 clipFromRelative(vec3 position) {
    vec3 view =
        vec3(dot(position, frame.right), dot(position, frame.up), dot(position, frame.forward));
    if (frame.orthographic != 0u)
        return vec4(view.x / frame.extentX, -view.y / frame.extentY,
                    (frame.far - view.z) / (frame.far - frame.near), 1.0);
    return vec4(view.x / frame.extentX, -view.y / frame.extentY, frame.near, view.z);
}

#endif
