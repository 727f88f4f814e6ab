#version 460
// SPDX-License-Identifier: Apache-2.0
// Writes the particles of all instances as spheres in the camera's space; slots without a particle get radius 0.
#extension GL_GOOGLE_include_directive : require
#include "passes.h"

#include "effect_block.glsl"
#include "../common/exponential.glsl"
#include "appearance.h"
#include "state.glsl"

layout(local_size_x_id = 0) in;
layout(set = 0, binding = kBindingTotals, scalar) readonly buffer TotalsBlock { TickTotals totals[]; };
layout(set = 0, binding = kBindingParticleSpheres, scalar) writeonly buffer ParticleSpheresBlock { SphereData spheres[]; };
layout(set = 0, binding = kBindingInstances, scalar) readonly buffer InstancesBlock { InstanceParameters instances[]; };
layout(set = 0, binding = kBindingAppearance, scalar) readonly buffer AppearanceBlock {
    AppearanceFrame frame;
    AppearancePlace places[];
};

void main() {
    uint thread = gl_GlobalInvocationID.x +
                  gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
    // The same for all instances.
    uint slots = totals[0].slots;
    if (thread >= slots * frame.instances) return;
    uint instance = thread / slots;
    uint slot = thread - instance * slots;
    AppearancePlace place = places[instance];
    SphereData sphere = SphereData(vec3(0), vec3(0), 0, vec3(0), 0, place.medium, 0u, frame.profile,
                                   kNoShares);
    if (slot < totals[instance].counters.alive) {
        uint i = instance * frame.capacity + slot;
        uint birthIndex;
        ParticleLife life = loadLife(i, birthIndex);
        vec3 position, velocity;
        loadMotion(i, position, velocity);
        Appearance appearance = evaluateAppearance(
            normalisedAge(life, frame.lastTick, frame.sinceTick), length(velocity));
        position += velocity * frame.sinceTickSeconds;
        sphere.center = place.origin;
        sphere.centerLo = place.originLo;
        addExactly(sphere.center, sphere.centerLo, place.axisX * position.x);
        addExactly(sphere.center, sphere.centerLo, place.axisY * position.y);
        addExactly(sphere.center, sphere.centerLo, place.axisZ * position.z);
        if (kIsThinned != 0u)
            appearance = thinOut(appearance, length(sphere.center) * frame.distanceScale,
                                 thinningRank(instances[instance].random, birthIndex));
        bool isShown = isShownAt(life, frame.lastTick, frame.sinceTick);
        sphere.radius = isShown ? appearance.radius * place.radiusScale : 0;
        sphere.tint = appearance.tint;
        sphere.density = appearance.density;
        sphere.id = place.firstId + birthIndex;
        if (frame.isShadowedWhole != 0u) sphere.shares = place.firstSphere + slot;
    }
    spheres[place.firstSphere + slot] = sphere;
}
