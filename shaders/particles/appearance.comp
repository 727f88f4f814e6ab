#version 460
// SPDX-License-Identifier: Apache-2.0
// Writes the particles as spheres in the camera's space; slots without a particle get radius 0.
#extension GL_GOOGLE_include_directive : require
#include "passes.h"

#include "effect_block.glsl"
#include "../common/exponential.glsl"
#include "appearance.h"

layout(local_size_x_id = 0) in;
layout(push_constant, scalar) uniform Push { AppearancePush push; };
layout(set = 0, binding = kBindingPositions, scalar) readonly buffer PositionsBlock { vec3 positions[]; };
layout(set = 0, binding = kBindingVelocities, scalar) readonly buffer VelocitiesBlock { vec3 velocities[]; };
layout(set = 0, binding = kBindingLives, scalar) readonly buffer LivesBlock { ParticleLife lives[]; };
layout(set = 0, binding = kBindingBirthIndices, scalar) readonly buffer BirthIndicesBlock { uint birthIndices[]; };
layout(set = 0, binding = kBindingTotals, scalar) readonly buffer TotalsBlock { TickTotals totals[]; };
layout(set = 0, binding = kBindingParticleSpheres, scalar) writeonly buffer ParticleSpheresBlock { SphereData spheres[]; };

void main() {
    uint slot = gl_GlobalInvocationID.x +
                gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
    TickTotals state = totals[push.instance];
    if (slot >= state.slots) return;
    SphereData sphere = SphereData(vec3(0), vec3(0), 0, vec3(0), 0, push.medium, 0u, push.profile,
                                   kNoShares);
    if (slot < state.counters.alive) {
        uint i = push.firstSlot + slot;
        ParticleLife life = lives[i];
        vec3 velocity = velocities[i];
        Appearance appearance =
            evaluateAppearance(normalisedAge(life, push.lastTick, push.sinceTick), length(velocity));
        vec3 position = positions[i] + velocity * push.sinceTickSeconds;
        sphere.center = push.origin;
        sphere.centerLo = push.originLo;
        addExactly(sphere.center, sphere.centerLo, push.axisX * position.x);
        addExactly(sphere.center, sphere.centerLo, push.axisY * position.y);
        addExactly(sphere.center, sphere.centerLo, push.axisZ * position.z);
        bool isShown = isShownAt(life, push.lastTick, push.sinceTick);
        sphere.radius = isShown ? appearance.radius * push.radiusScale : 0;
        sphere.tint = appearance.tint;
        sphere.density = appearance.density;
        sphere.id = push.firstId + birthIndices[i];
        if (push.isShadowedWhole != 0u) sphere.shares = push.firstSphere + slot;
    }
    spheres[push.firstSphere + slot] = sphere;
}
