// SPDX-License-Identifier: Apache-2.0
// The list of modules that have parameters of their own on both sides: X(struct, member of
// EffectParameters, specialisation constant of its count). A pipeline is compiled for the counts of
// its effect, so that a module without use costs nothing.
#ifndef BRUME_SHADERS_PARTICLES_MODULES_MODULES_H
#define BRUME_SHADERS_PARTICLES_MODULES_MODULES_H

#include "attractor.h"
#include "buoyancy.h"
#include "collide_box.h"
#include "collide_capsule.h"
#include "collide_level_set.h"
#include "collide_plane.h"
#include "collide_sphere.h"
#include "curl_noise.h"
#include "quadratic_drag.h"
#include "velocity_field.h"
#include "vortex.h"

#define BRUME_MODULE_TYPES(X)                \
    X(CurlNoise, curlNoise, 1)               \
    X(Vortex, vortex, 2)                     \
    X(Attractor, attractor, 3)               \
    X(QuadraticDrag, quadraticDrag, 4)       \
    X(PlaneCollider, planeCollider, 5)       \
    X(SphereCollider, sphereCollider, 6)     \
    X(BoxCollider, boxCollider, 7)           \
    X(CapsuleCollider, capsuleCollider, 8)   \
    X(VelocityField, velocityField, 9)       \
    X(Buoyancy, buoyancy, 10)                \
    X(LevelSetCollider, levelSetCollider, 11) \
    X(VelocityField, birthField, 12)

#endif
