// SPDX-License-Identifier: Apache-2.0
// The shadow store of a scene without shadows. Every store supplies this one function.
#ifndef BRUME_SHADOWS_NONE_TRANSMITTANCE_GLSL
#define BRUME_SHADOWS_NONE_TRANSMITTANCE_GLSL

// Share of light `index` that reaches `position` (camera-relative), per channel in [0, 1].
vec3 transmittance(uint index, vec3 position) { return vec3(1); }

#endif
