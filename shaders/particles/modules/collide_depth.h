// SPDX-License-Identifier: Apache-2.0
// Collision with what a picture's opaque meshes show of themselves: the surface behind each pixel is
// `thickness` thick, its normal that of the plane through the neighbouring pixels. Not replayable: it
// depends on the camera and the size of the image.
// Source: the scene-depth collisions of production particle systems, e.g. Tchou, "Halo: Reach effects
// tech", GDC 2011; the normal takes the nearer neighbour on either axis. Limits: what is outside the
// image or hidden is not there; a particle faster than `thickness` per tick may pass; near the rims of
// surfaces normals are off; sub-emitters do not see these hits.
#ifndef BRUME_SHADERS_PARTICLES_MODULES_COLLIDE_DEPTH_H
#define BRUME_SHADERS_PARTICLES_MODULES_COLLIDE_DEPTH_H

#include "../../common/shared_math.h"
#include "../contact.h"

BRUME_STRUCTS_BEGIN

BRUME_CONST uint kBindingSceneDepth = 32u;     // sampler2D: distance along the ray, m
BRUME_CONST uint kBindingDepthCollider = 33u;  // DepthCollision, then DepthPlace[] by instance

/// The module's settings, in effect space.
struct DepthCollider {
    float thickness;  // m
    float radius;     // of the particles, m
    ContactSurface surface;
};

/// The picture, and the collider of the population; positions are relative to the camera.
struct DepthCollision {
    DepthCollider collider;
    float restSpeed;  // slower hits do not bounce, m/s in effect space
    uint instances;
    uint capacity;  // of one instance
    vec3 right;
    float extentX;  // half size of the image plane, in perspective at distance 1
    vec3 up;
    float extentY;
    vec3 forward;
    uint isOrthographic;
    uvec2 size;  // pixels
};

/// From an instance's space to the camera's, and back.
struct DepthPlace {
    vec3 axisX;
    vec3 axisY;
    vec3 axisZ;
    vec3 origin;
    vec3 inverseX;
    vec3 inverseY;
    vec3 inverseZ;
    float scale;  // of lengths
};

BRUME_STRUCTS_END

#ifdef __cplusplus
static_assert(sizeof(brume::shader::DepthCollider) == 20);
static_assert(offsetof(brume::shader::DepthCollision, right) == 32);
static_assert(sizeof(brume::shader::DepthPlace) == 88);
#endif
#endif
