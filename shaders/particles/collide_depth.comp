#version 460
// SPDX-License-Identifier: Apache-2.0
// After a tick: particles that have come behind the surface that a picture shows are put back onto it. One invocation
// per slot of each instance.
#extension GL_GOOGLE_include_directive : require
#include "passes.h"
#include "modules/collide_depth.h"

layout(local_size_x_id = 0) in;
layout(set = 0, binding = kBindingState, scalar) buffer State0 { uint64_t state0[]; };
layout(set = 0, binding = kBindingState + 1, scalar) buffer State1 { uint64_t state1[]; };
layout(set = 0, binding = kBindingState + 2, scalar) buffer State2 { uint64_t state2[]; };
layout(set = 0, binding = kBindingState + 3, scalar) buffer State3 { uint64_t state3[]; };
layout(set = 0, binding = kBindingState + 4, scalar) buffer State4 { uint64_t state4[]; };
layout(set = 0, binding = kBindingTotals, scalar) readonly buffer TotalsBlock { TickTotals totals[]; };
layout(set = 0, binding = kBindingSceneDepth) uniform sampler2D sceneDepth;
layout(set = 0, binding = kBindingDepthCollider, scalar) readonly buffer CollisionBlock {
    DepthCollision picture;
    DepthPlace places[];
};

const float kFarthest = 1e30;  // beyond it there is nothing
const float kStillSpeed = 1e-6;

/// Relative to the camera, unit in perspective; the ray begins at `start`.
vec3 rayOf(vec2 pixel, out vec3 start) {
    vec2 s = (2.0 * pixel / vec2(picture.size) - 1.0) * vec2(picture.extentX, -picture.extentY);
    vec3 offset = s.x * picture.right + s.y * picture.up;
    bool isParallel = picture.isOrthographic != 0u;
    start = isParallel ? offset : vec3(0);
    return isParallel ? picture.forward : normalize(picture.forward + offset);
}

float distanceAt(ivec2 pixel) {
    return texelFetch(sceneDepth, clamp(pixel, ivec2(0), ivec2(picture.size) - 1), 0).x;
}

vec3 placeAt(ivec2 pixel) {
    vec3 start;
    vec3 ray = rayOf(vec2(pixel) + 0.5, start);
    return start + ray * distanceAt(pixel);
}

/// Along one axis of the image, towards the neighbour whose distance is more alike.
vec3 slopeAt(ivec2 pixel, ivec2 axis) {
    float here = distanceAt(pixel);
    bool isNextInside = all(lessThan(pixel + axis, ivec2(picture.size)));
    bool isLastInside = all(greaterThanEqual(pixel - axis, ivec2(0)));
    float next = isNextInside ? abs(distanceAt(pixel + axis) - here) : 2.0 * kFarthest;
    float last = isLastInside ? abs(distanceAt(pixel - axis) - here) : 2.0 * kFarthest;
    return next <= last ? placeAt(pixel + axis) - placeAt(pixel) : placeAt(pixel) - placeAt(pixel - axis);
}

/// Whether the picture has something at a place, and its plane there; the normal looks towards the camera.
bool findSurface(vec3 place, float scale, out vec3 onSurface, out vec3 normal) {
    float depth = dot(place, picture.forward);
    bool isParallel = picture.isOrthographic != 0u;
    vec2 s = vec2(dot(place, picture.right) / picture.extentX, -dot(place, picture.up) / picture.extentY);
    if (!isParallel) s /= max(depth, 1e-6);
    if (!(depth > 0.0 && abs(s.x) < 1.0 && abs(s.y) < 1.0)) return false;
    ivec2 pixel = ivec2((0.5 * s + 0.5) * vec2(picture.size));
    float seen = distanceAt(pixel);
    if (!(seen < kFarthest)) return false;
    vec3 start;
    vec3 ray = rayOf((0.5 * s + 0.5) * vec2(picture.size), start);
    onSurface = placeAt(pixel);
    vec3 across = cross(slopeAt(pixel, ivec2(1, 0)), slopeAt(pixel, ivec2(0, 1)));
    float area = length(across);
    if (!(area > 0.0)) return false;
    normal = dot(across, ray) > 0.0 ? -across / area : across / area;
    // How far the place lies behind what is seen; the plane alone would reach beyond its rims.
    float behind = (dot(place - start, ray) - seen) * max(-dot(normal, ray), 0.2);
    return behind < picture.collider.thickness * scale;
}

/// What friction and restitution leave of a velocity towards the surface, in the camera's space.
vec3 bounce(vec3 velocity, vec3 normal, float scale) {
    ContactSurface surface = picture.collider.surface;
    float towards = -dot(velocity, normal);
    vec3 along = velocity + normal * towards;
    float back = towards > picture.restSpeed * scale ? surface.restitution * towards : 0.0;
    float speed = length(along);
    float loss = surface.friction * (towards + back);
    along *= speed > kStillSpeed ? max(speed - loss, 0.0) / speed : 0.0;
    return along + normal * back;
}

void main() {
    uint thread = gl_GlobalInvocationID.x +
                  gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
    uint slots = totals[0].slots;
    if (thread >= slots * picture.instances) return;
    uint instance = thread / slots;
    uint slot = thread - instance * slots;
    if (slot >= totals[instance].counters.alive) return;
    uint i = instance * picture.capacity + slot;
    vec2 a = uintBitsToFloat(unpackUint2x32(state0[i]));
    vec2 b = uintBitsToFloat(unpackUint2x32(state1[i]));
    vec2 c = uintBitsToFloat(unpackUint2x32(state2[i]));
    vec3 position = vec3(a, b.x), velocity = vec3(b.y, c);

    DepthPlace place = places[instance];
    mat3 toCamera = mat3(place.axisX, place.axisY, place.axisZ);
    mat3 fromCamera = mat3(place.inverseX, place.inverseY, place.inverseZ);
    vec3 seenPlace = toCamera * position + place.origin;
    vec3 seenVelocity = toCamera * velocity;
    vec3 onSurface, normal;
    if (!findSurface(seenPlace, place.scale, onSurface, normal)) return;
    float height = dot(seenPlace - onSurface, normal) - picture.collider.radius * place.scale;
    if (height >= 0.0) return;

    position += fromCamera * (normal * -height);
    uint response = picture.collider.surface.response;
    if (response == kResponseStick)
        velocity = vec3(0);
    else if (dot(seenVelocity, normal) < 0.0)
        velocity = fromCamera * bounce(seenVelocity, normal, place.scale);
    state0[i] = packUint2x32(floatBitsToUint(position.xy));
    state1[i] = packUint2x32(floatBitsToUint(vec2(position.z, velocity.x)));
    state2[i] = packUint2x32(floatBitsToUint(velocity.yz));
    // The sign bit of its birth says that a particle sticks, a negative lifetime that it dies in the next tick.
    uvec2 birth = unpackUint2x32(state3[i]), rest = unpackUint2x32(state4[i]);
    if (response == kResponseStick) state3[i] = packUint2x32(uvec2(birth.x, birth.y | 0x80000000u));
    if (response == kResponseKill) state4[i] = packUint2x32(uvec2(floatBitsToUint(-1.0), rest.y));
}
