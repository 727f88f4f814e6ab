// SPDX-License-Identifier: Apache-2.0
// A host's pane of coloured glass over all of the image.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../host/brume_store.glsl"

layout(push_constant) uniform Push {
    vec4 radiance;
    vec4 transmittanceDistance;
};

void main() { brumeStore(radiance.rgb, transmittanceDistance.rgb, transmittanceDistance.w); }
