#version 460
// SPDX-License-Identifier: Apache-2.0
// Writes the particles as spheres in the camera's space; slots without a particle get radius 0.
#extension GL_GOOGLE_include_directive : require
#include "passes.h"

#include "effect_block.glsl"
#include "../common/exponential.glsl"
#include "appearance.h"
#include "state.glsl"

layout(local_size_x_id = 0) in;
layout(push_constant, scalar) uniform Push { AppearancePush push; };
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
        uint birthIndex;
        ParticleLife life = loadLife(i, birthIndex);
        vec3 position, velocity;
        loadMotion(i, position, velocity);
        Appearance appearance =
            evaluateAppearance(normalisedAge(life, push.lastTick, push.sinceTick), length(velocity));
        position += velocity * push.sinceTickSeconds;
        sphere.center = push.origin;
        sphere.centerLo = push.originLo;
        addExactly(sphere.center, sphere.centerLo, push.axisX * position.x);
        addExactly(sphere.center, sphere.centerLo, push.axisY * position.y);
        addExactly(sphere.center, sphere.centerLo, push.axisZ * position.z);
        bool isShown = isShownAt(life, push.lastTick, push.sinceTick);
        sphere.radius = isShown ? appearance.radius * push.radiusScale : 0;
        sphere.tint = appearance.tint;
        sphere.density = appearance.density;
        sphere.id = push.firstId + birthIndex;
        if (push.isShadowedWhole != 0u) sphere.shares = push.firstSphere + slot;
    }
    spheres[push.firstSphere + slot] = sphere;
}
