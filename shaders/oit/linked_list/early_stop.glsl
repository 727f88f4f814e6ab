// SPDX-License-Identifier: Apache-2.0
// Where a pixel may stop: when all that can still come from behind, as bright as media, surfaces and
// lights allow, is less than epsilon.
#ifndef BRUME_OIT_LINKED_LIST_EARLY_STOP_GLSL
#define BRUME_OIT_LINKED_LIST_EARLY_STOP_GLSL
#include "../integrate/path.glsl"

float stopBelow = 1e-20;  // transmittance
float brightest = 3e38;   // radiance

// More media and lights than this are not looked through.
const uint kMostSources = 256u;

float largestOf(vec3 v) { return max(v.x, max(v.y, v.z)); }
float restOf(Path path) { return largestOf(path.surfaces * path.decay); }
bool canStop(Path path) { return restOf(path) < stopBelow; }

float phasePeak(MediumData medium) {
    return phaseFunction(medium.phase, medium.g, medium.g < 0.0 ? -1.0 : 1.0);
}

// Radiance per optical depth of a medium of albedo 1 in the brightest light there is.
vec3 brightestLight(float phase) {
    vec3 sum = frame.ambient;
    for (uint i = 0u; i < frame.lightCount; ++i) {
        LightData light = lights[i];
        bool isAround = light.type != kLightDirectional;
        sum += light.color * (phase / (isAround ? max(light.radius * light.radius, 1e-30) : 1.0));
    }
    return sum;
}

float brightestMedium() {
    float most = kSolids ? largestOf(brightestLight(phaseIsotropic())) : 0.0;  // solids
    for (uint m = 0u; m < frame.mediumCount; ++m) {
        MediumData medium = media[m];
        vec3 source = medium.albedo * brightestLight(phasePeak(medium));
        // What glows without absorbing has no bound.
        vec3 glow = medium.emission / max(medium.extinction, vec3(1e-30));
        most = max(most, push.largestTint * largestOf(source + glow));
    }
    return most;
}

// All surfaces of a list together. `from`, `to`: of its entries.
float brightestSurfaces(uint from, uint to) {
    float sum = 0.0;
    for (uint i = from; i < to; ++i) sum += largestOf(loadRecord(loadEntry(i)).surface.radiance);
    iterations += to - from;
    return sum;
}

void allowStop(vec3 behind) {
    if (push.epsilon <= 0.0 || frame.mediumCount * (frame.lightCount + 1u) > kMostSources) return;
    brightest = max(brightestMedium(), largestOf(behind));
    if (kSurfaces) brightest += brightestSurfaces(mediaCount, count);
    iterations += frame.mediumCount * (frame.lightCount + 1u);
    stopBelow = max(push.epsilon / max(brightest, 1.0), 1e-20);
}

void countStop(Path path) {
    atomicAdd(CounterBlock(push.counters).counters.stopped, 1u);
    float bound = restOf(path) * brightest;
    atomicMax(CounterBlock(push.counters).counters.bound, floatBitsToUint(bound));
}

#endif
