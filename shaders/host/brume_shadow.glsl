// SPDX-License-Identifier: Apache-2.0
// For shaders of hosts: how much of a light's light Brume's smoke and glass let through.
//
//   #extension GL_GOOGLE_include_directive : require
//   #include "host/brume_shadow.glsl"            // with -I <prefix>/include/brume/glsl
//   vec3 t = brumeTransmittance(shadow, position);
//
// It binds nothing: `shadow` is the 64-bit address that brumeGetShadow() returns, e.g. from a push
// constant. Needs bufferDeviceAddress, scalarBlockLayout and shaderInt64, which Brume's context
// needs anyway. Valid for commands after brumeCmdShadow(); not for lights with the store "exact".
#ifndef BRUME_HOST_BRUME_SHADOW_GLSL
#define BRUME_HOST_BRUME_SHADOW_GLSL
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require

// What belongs to Brume's own passes stays out: their bindings, and the store that needs them.
#define BRUME_COMMON_BINDINGS_GLSL
#define BRUME_COMMON_CAMERA_GLSL
#define BRUME_SHADOWS_EXACT_TRANSMITTANCE_GLSL
struct Ray {  // as in camera.glsl
    vec3 origin;
    vec3 direction;
};
#include "../shadows/common/map.glsl"

vec3 exactTransmittance(ShadowMap map, vec3 position, MapPoint point) { return vec3(1); }

struct BrumeLight {
    uint64_t shadow;
};
BrumeLight lights[1];
#include "../shadows/transmittance.glsl"

// `position`: in the world, m, relative to the position of the camera of brumeCmdShadow()'s view.
// Per channel in [0, 1]; 1 where `shadow` is 0.
vec3 brumeTransmittance(uint64_t shadow, vec3 position) {
    lights[0].shadow = shadow;
    return transmittance(0u, position);
}

#endif
