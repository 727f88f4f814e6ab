// SPDX-License-Identifier: Apache-2.0
// Phase functions, 1/sr; each integrates to 1 over the sphere. CPU twin: core/phase.hpp.
#ifndef BRUME_COMMON_PHASE_GLSL
#define BRUME_COMMON_PHASE_GLSL

const float kInverse4Pi = 0.07957747154594767;

float phaseIsotropic() { return kInverse4Pi; }

// Barta & Kovacs 2011, section 2.1.
float phaseRayleigh(float cosTheta) { return 0.05968310365946075 * (1.0 + cosTheta * cosTheta); }

// cosTheta between the directions in which the light travels before and after; |g| <= 0.999.
float phaseHenyeyGreenstein(float cosTheta, float g) {
    // 1 + g^2 - 2 g cosTheta, without its cancellation near g = 1.
    float a = (1.0 - g) * (1.0 - g) + 2.0 * g * (1.0 - cosTheta);
    return kInverse4Pi * (1.0 - g * g) / (a * sqrt(a));
}

float phaseFunction(uint phase, float g, float cosTheta) {
    if (phase == kPhaseHenyeyGreenstein) return phaseHenyeyGreenstein(cosTheta, g);
    return phase == kPhaseRayleigh ? phaseRayleigh(cosTheta) : phaseIsotropic();
}

#endif
