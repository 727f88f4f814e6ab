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

// The place of a pixel on the image plane. `position`: pixels from the top-left corner; centres at
// + 0.5.
Real3 pixelPlace(vec2 position) {
    return makeReal(frame.corner, frame.cornerLo) +
           Real(position.x) * makeReal(frame.pixelRight, frame.pixelRightLo) +
           Real(position.y) * makeReal(frame.pixelDown, frame.pixelDownLo);
}

Ray makeRay(vec2 position) {
    precise vec3 place =
        frame.corner + position.x * frame.pixelRight + position.y * frame.pixelDown;
    if (hasParallelRays()) return Ray(place, frame.forward);
    return Ray(vec3(0), normalize(place));
}

RealRay makeRealRay(vec2 position) {
    Real3 place = pixelPlace(position);
    if (hasParallelRays()) return RealRay(place, makeReal(frame.forward, frame.forwardLo));
    return RealRay(Real3(0), place / sqrt(dot(place, place)));
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
